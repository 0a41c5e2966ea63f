// Which contacts carry load: the search for the set that satisfies every condition at one pose, and the certificate
// that it does.
//
// Dortmans 1984: a contact whose force turns negative is dropped. A gap that turns negative is added; a contact that is
// no longer a minimum of the gap is replaced by the minima beside it.
#pragma once

#include <string>
#include <vector>

#include "genu/equilibrium/contact_inspection.h"
#include "genu/equilibrium/descent_seed.h"
#include "genu/equilibrium/newton.h"

namespace genu {

/// A contact point that was closed once and is open now: still followed for its gap.
struct OpenContact {
  int pair = 0;
  int number = 0;  ///< 0: never closed, and looked at for its gap alone
  ContactGeometry geometry;
  double gap = 0;  ///< m
};

/// A state with the history that its numbering of contacts needs.
struct Balanced {
  State state;
  std::vector<OpenContact> open;
  std::vector<int> last_number;  ///< of each pair: numbers are not used twice
};

/// Why a pose is or is not accepted; `status` words in results are to_string of it.
enum class PoseStatus { ok, no_equilibrium, over_edge, overlap, chatter, overconstrained, undetermined, flawed_mesh };
const char* to_string(PoseStatus status);

struct PoseReport {
  PoseStatus status = PoseStatus::no_equilibrium;
  std::string why;
  int iterations = 0;
  NewtonReport newton;  ///< the last solve
  Certificate certificate;
};

class ActiveSetSolver {
 public:
  ActiveSetSolver(const JointModel& model, ContactField& field, const NewtonOptions& options);

  /// Newton with the contacts of `pose` as they are; checks, but changes no contact.
  PoseReport solve_held(Balanced& pose, const Target& target, Findings& findings);

  /// Looks at a pose that is solved: what is wrong with its contacts, and what it is worth.
  PoseReport inspect(const State& state, const NewtonReport& newton, Findings& findings);

  /// One change of the contact set for what was found. False where there is none to make.
  bool change(Balanced& pose, const Target& target, const Findings& findings) const;

  /// Newton and changes of the contact set until nothing is wrong. On failure `pose` is left as it was.
  PoseReport settle(Balanced& pose, const Target& target);

  /// From far: a compliant seed first, then settle() from the contacts it shows. `downhill`: the seed moves toward less
  /// energy all the way (descent_seed.h), so that it ends at a stable pose.
  PoseReport settle_from_seed(Balanced& pose, const Target& target, bool downhill = false);

  /// From a pose never solved: the contacts that touch or overlap already, else a compliant seed; the seed as well
  /// where the bodies would have to pass through each other on the way. Last downhill, where Newton's method wanders:
  /// in long steps, then in short ones.
  PoseReport settle_cold(Balanced& pose, const Target& target);

  /// The residual that Newton's method is to come below; where rounding keeps it above, it may accept a larger one.
  double tolerance() const { return options_.residual_tolerance; }

  /// Where surfaces touch in a solved state and no contact is held.
  std::vector<Candidate> touching(const State& state,
                                  ContactInspector::Touching which = ContactInspector::Touching::places,
                                  double within = 0);

  /// Follows open contacts to the new pose and forgets those that are no more.
  void follow_open(Balanced& pose);

  /// Holds a minimum closed from now on, under its old number where it had one.
  void close(Balanced& pose, const Candidate& candidate) const;
  void release(Balanced& pose, int contact) const;

  /// Most contacts that `target` leaves room for (N + M <= 5 for one moving body).
  int contact_limit(const Target& target) const;

  /// Whether the bodies overlap on the straight way from one pose to the other by more than rolling over each other
  /// does. `followed`: along a path, of which a shorter step can be tried.
  bool passes_through(const State& from, const State& to, bool followed = false);

  Newton& newton() { return newton_; }
  const JointModel& model() const { return *model_; }
  ContactField& field() { return *field_; }

 private:
  struct SeedWay {
    bool downhill = false;
    double stiffer = 1;  ///< than usual, the foundation at first
    Stride stride = Stride::usual;
  };
  PoseReport settle_from_seed(Balanced& pose, const Target& target, const SeedWay& way);
  PoseReport settle_without_one(Balanced& pose, const Balanced& failed, const Target& target,
                                const PoseReport& failure);
  PoseReport judge(const State& state, const NewtonReport& newton, const Findings& findings) const;
  void close_touching(Balanced& pose, const Target& target, double below);

  const JointModel* model_;
  ContactField* field_;
  NewtonOptions options_;
  Newton newton_;
  ContactInspector inspector_;
  Survey survey_;
};

}  // namespace genu
