// The active set: which contacts carry load at one pose, and the certificate that all conditions hold.
//
// Dortmans 1984: a contact whose force turns negative is dropped, and a gap that turns negative is added. A contact
// that is no longer a minimum of the gap is replaced by the minima beside it.
#pragma once

#include <string>
#include <vector>

#include "genu/equilibrium/contact_inspection.h"
#include "genu/equilibrium/descent_seed.h"
#include "genu/equilibrium/newton.h"

namespace genu {

/// A contact point that was closed before and is open now. Its gap is still followed.
struct OpenContact {
  int pair = 0;
  int number = 0;  ///< 0: never closed, followed for its gap only
  ContactGeometry geometry;
  double gap = 0;  ///< m
};

/// A state with the history that the numbering of its contacts needs.
struct Balanced {
  State state;
  std::vector<OpenContact> open;
  std::vector<int> last_number;  ///< of each pair; no number is used twice
};

/// Why a pose is or is not accepted. Column `status` of the results contains to_string() of it.
enum class PoseStatus {
  ok,
  no_equilibrium,
  over_edge,
  overlap,
  chatter,
  overconstrained,
  undetermined,
  flawed_mesh,
  slips_off,
  lifts_off
};
const char* to_string(PoseStatus status);

struct PoseReport {
  PoseStatus status = PoseStatus::no_equilibrium;
  std::string why;
  bool adrift = false;  ///< no equilibrium: the loads drive a body away, and nothing stops it
  int iterations = 0;
  NewtonReport newton;  ///< the last solve
  Certificate certificate;
};

class ActiveSetSolver {
 public:
  ActiveSetSolver(const JointModel& model, ContactField& field, const NewtonOptions& options);

  /// Newton's method with the contacts of `pose` fixed. Checks the result and changes no contact. Where a ligament or
  /// touch has left its piece, contacts are not searched for: there is no certificate.
  /// `locating`: a change is located by what is found, so the pose is solved to kLocatingResidual at least.
  PoseReport solve_held(Balanced& pose, const Target& target, Findings& findings, bool locating = false);

  /// Newton's method with the contacts of `state` fixed, to locate a change. Checks nothing; on failure `state` is
  /// unchanged.
  NewtonReport solve_unchecked(State& state, const Target& target) { return newton_.solve(state, target, locating_); }

  /// ContactInspector::margin_of_contact().
  double margin_of_contact(const State& state, Findings& found) { return inspector_.margin_of_contact(state, found); }

  /// Checks a solved pose: conditions that its contacts violate, and its certificate.
  PoseReport inspect(const State& state, const NewtonReport& newton, Findings& findings);

  /// Makes one change of the active set in answer to `findings`. False where there is none to make.
  bool change(Balanced& pose, const Target& target, const Findings& findings) const;

  /// Alternates Newton's method and changes of the active set until all conditions hold. On failure `pose` is
  /// unchanged.
  PoseReport settle(Balanced& pose, const Target& target);

  /// From a distant start: a compliant seed, then settle() from the contacts of the seed. `downhill`: the seed descends
  /// in energy (descent_seed.h) and so ends at a stable pose.
  PoseReport settle_from_seed(Balanced& pose, const Target& target, bool downhill = false) {
    return settle_from_seed(pose, target, SeedWay{.downhill = downhill});
  }

  /// From where an equilibrium has ended: slides in contact to the next pose of rest (rigid_descent.h).
  PoseReport settle_downhill(Balanced& pose, const Target& target);

  /// From a pose that was never solved: starts from the contacts that touch or overlap, else from a compliant seed. The
  /// seed is also used where bodies would otherwise pass through each other. Where Newton's method wanders, descent
  /// seeds follow: first with long steps, then with short ones.
  PoseReport settle_cold(Balanced& pose, const Target& target);

  /// Scaled residual that Newton's method aims for. Where rounding prevents that, it may accept up to the floor.
  double tolerance() const { return options_.residual_tolerance; }

  /// Places where surfaces touch in a solved state without an active contact.
  std::vector<Candidate> touching(const State& state,
                                  ContactInspector::Touching which = ContactInspector::Touching::places,
                                  double within = 0);

  /// Follows open contacts to the new pose. Drops those that no longer exist.
  void follow_open(Balanced& pose);

  /// Adds a minimum of the gap to the active set, under its old number if it had one.
  void close(Balanced& pose, const Candidate& candidate) const;
  void release(Balanced& pose, int contact) const;

  /// Largest number of contacts for `target`: N + M <= 6 for one moving body, M constraints. With 6 nothing is free to
  /// move.
  int contact_limit(const Target& target) const;

  /// Whether the bodies overlap on the straight way between two poses by more than rolling explains. `followed`: the
  /// poses lie on a path, where a shorter step can be tried.
  bool passes_through(const State& from, const State& to, bool followed = false);

  Newton& newton() { return newton_; }
  const JointModel& model() const { return *model_; }
  ContactField& field() { return *field_; }

 private:
  struct SeedWay {
    bool downhill = false;
    double stiffer = 1;  ///< factor on the stiffness of the first foundation
    Stride stride = Stride::usual;
  };
  PoseReport settle_from_seed(Balanced& pose, const Target& target, const SeedWay& way);
  /// settle(), with contact forces guessed where that fails.
  PoseReport settle_or_guess(Balanced& pose, const Target& target);
  PoseReport settle_without_one(Balanced& pose, const Balanced& failed, const Target& target,
                                const PoseReport& failure);
  static PoseReport judge(const NewtonReport& newton, const Findings& findings);
  void close_touching(Balanced& pose, const Target& target, double below);

  const JointModel* model_;
  ContactField* field_;
  NewtonOptions options_;
  NewtonOptions locating_;  ///< the same, to kLocatingResidual at least
  Newton newton_;
  ContactInspector inspector_;
  Survey survey_;
};

}  // namespace genu
