// Where ligaments pass the breaks of their laws at which force and stiffness are continuous: toe to line, slack to a
// quadratic rise. Such a break concerns no solve, so the path is walked as if it were not there, and it is located
// afterwards between the two ends of an accepted substep.
//
// There the length is the cubic of its values and rates at both ends (rates from the tangents), which errs by the
// fourth power of the substep. Near the cubic's root Newton's method finds the pose together with its place on the
// path; where it does not, poses solved between both ends close in on it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "genu/path/path_options.h"

namespace genu {

class LawEvents {
 public:
  /// One end of a substep: a solved state, and the rate of its twists (6 for each moving body) with respect to the
  /// substep as a whole; null where it is not known.
  struct End {
    const State& state;
    const VecX* twist;
  };
  struct Passed {
    double u;  ///< of the substep, 0 to 1
    PathEvent::Kind kind;
    std::string what;  ///< the ligament
    State state;       ///< there; the end of the substep for bodies that leap
  };
  /// Solves the pose at u, 0 < u < 1, of the substep. False where that fails.
  using PoseAt = std::function<bool(double u, State& out)>;
  /// Solves the pose and u together so that a ligament has a length (m), from u as it is given and a pose of its own.
  /// False where that fails.
  using EventAt = std::function<bool(int ligament, double length, double& u, State& out)>;
  /// How to look between both ends; either may be missing.
  struct Solves {
    PoseAt pose_at;
    EventAt event_at;
  };

  explicit LawEvents(const JointModel& model);

  /// Whether the model has no such break: then the calls below do nothing.
  bool none() const { return watched_.empty(); }

  /// m: as near to a break is at it.
  double rounding() const { return rounding_; }

  /// All breaks passed over a substep, in path order, each located to `tolerance` in u; without a `pose_at` (bodies
  /// that leap) at its end. The sides on which the first substep begins are where the ligaments are; later ones begin
  /// where the last has ended, so that nothing is lost or told twice between two steps. The result is valid until the
  /// next call.
  const std::vector<Passed>& over(const End& from, const End& to, double tolerance, const Solves& solves);

  /// The sides on which the ligaments are.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(begun_);
    for (Watched& w : watched_) archive(w.above);
  }

 private:
  struct Watched {
    int ligament;
    LawBreak law_break;
    bool above = false;
  };
  /// A point of the substep where a length is known: how far it is past the break (m) and how fast that grows (m per
  /// u).
  struct Node {
    double u, past, rate;
  };
  double length(const Watched& w, const State& state) const;
  Node node(const Watched& w, const End& end, double u) const;
  void follow(Watched& w, const Node& from, const Node& to, const State& end);
  void pass(Watched& w, const Node& from, const Node& to, const State& end);
  void locate(const Watched& w, const Node& from, const Node& to, Passed& out);
  bool solve(const Watched& w, double u, double& past);
  bool solve_event(const Watched& w, const Node& from, const Node& to, double u, Passed& out);

  const JointModel* model_;
  double rounding_;  ///< m: a length this near to a break has not left the side it was on
  std::vector<Watched> watched_;
  bool begun_ = false;
  std::vector<Passed> passed_;
  State between_;
  const Solves* solves_ = nullptr;
  double tolerance_ = 0;
};

}  // namespace genu
