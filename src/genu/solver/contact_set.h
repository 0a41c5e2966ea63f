// Which contacts carry load: the search for the set that satisfies every condition at one pose, and the certificate that
// it does.
//
// Dortmans 1984: a contact whose force turns negative is dropped. A gap that turns negative is added; a contact that is no
// longer a minimum of the gap is replaced by the minima beside it.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "genu/model/contact_field.h"
#include "genu/solver/newton.h"
#include "genu/solver/stability.h"

namespace genu {

/// A contact point that was closed once and is open now: still followed for its gap.
struct OpenContact {
  int pair = 0;
  int number = 0;
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
enum class PoseStatus { ok, no_equilibrium, over_edge, overlap, chatter, overconstrained, undetermined };
const char* to_string(PoseStatus status);

/// What was verified at an accepted pose, and by how much.
struct Certificate {
  double residual = 0;       ///< scaled
  double smallest_force = 0; ///< N, +infinity without contact
  double smallest_gap = 0;   ///< m, over the whole of every pair; +infinity when all are clear
  double least_opposed = -1; ///< largest n_A . n_B of any contact, -1 is exactly opposed
  double edge_distance = 0;  ///< m: least distance of a contact point to an edge of its patch
};

/// What is wrong with a converged state.
struct Findings {
  std::vector<int> pulling;             ///< active contacts with negative force, worst first
  std::vector<Candidate> overlapping;   ///< minima with negative gap that are not held, deepest first
  std::vector<int> not_minimal;         ///< active contacts at a saddle of the gap
  std::vector<Candidate> beside;        ///< minima found beside those
  bool over_edge = false;               ///< a contact point or an overlap lies past the edge of a patch
  bool deep_overlap = false;            ///< samples overlap where no contact explains it
  double worst = std::numeric_limits<double>::infinity();  ///< smallest of scaled forces and gaps not held: < 0 when wrong
  std::string where;                    ///< for over_edge and deep_overlap, in words

  bool none() const { return pulling.empty() && overlapping.empty() && not_minimal.empty() && !over_edge && !deep_overlap; }
};

struct PoseReport {
  PoseStatus status = PoseStatus::no_equilibrium;
  std::string why;
  int iterations = 0;
  NewtonReport newton;  ///< the last solve
  Certificate certificate;
};

class ContactSetSolver {
 public:
  /// An overlap below this (m) is none: 1e-12 of the characteristic length, and what rounding makes of the distance of
  /// the bodies from the world's origin. Two contacts about to merge turn an overlap of 1 nm into 0.001 deg.
  double gap_tolerance() const { return gap_tolerance_; }
  static constexpr double kForceTolerance = 1e-9;  ///< of the force scale: a pull below this is none

  ContactSetSolver(const JointModel& model, ContactField& field, const NewtonOptions& options);

  /// Newton with the contacts of `pose` as they are; checks, but changes no contact.
  PoseReport solve_held(Balanced& pose, const Target& target, Findings& findings);

  /// Newton and changes of the contact set until nothing is wrong. On failure `pose` is left as it was.
  PoseReport settle(Balanced& pose, const Target& target);

  /// From far: a compliant seed first, then settle() from the contacts it shows.
  PoseReport settle_from_seed(Balanced& pose, const Target& target);

  /// From a pose never solved: the contacts that touch or overlap already, else a compliant seed.
  PoseReport settle_cold(Balanced& pose, const Target& target);

  /// Follows open contacts to the new pose and forgets those that are no more.
  void follow_open(Balanced& pose);

  /// Holds a minimum closed from now on, under its old number where it had one.
  void close(Balanced& pose, const Candidate& candidate) const;
  void release(Balanced& pose, int contact) const;

  /// Most contacts that `target` leaves room for (N + M <= 5 for one moving body).
  int contact_limit(const Target& target) const;

  Newton& newton() { return newton_; }
  const JointModel& model() const { return *model_; }
  ContactField& field() { return *field_; }

 private:
  void inspect(const State& state, Findings& out);
  void inspect_contacts(const State& state, Findings& out);
  bool held(const State& state, const Candidate& candidate) const;
  bool change(Balanced& pose, const Target& target, const Findings& findings) const;
  PoseReport judge(const State& state, const NewtonReport& newton, const Findings& findings);
  void close_touching(Balanced& pose, const Target& target, double below);

  const JointModel* model_;
  ContactField* field_;
  NewtonOptions options_;
  double gap_tolerance_;
  Newton newton_;
  Survey survey_;
};

}  // namespace genu
