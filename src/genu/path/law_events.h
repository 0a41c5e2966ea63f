// Locates the points where ligaments pass breaks of their laws with continuous force and stiffness: toe to line, slack
// to a quadratic rise. No solve has to know them. Continuation ignores them, and they are located afterwards between
// the two ends of an accepted step.
//
// There the length is interpolated by the cubic of its values and rates at both ends (rates from the tangents), with an
// error of fourth order in the step. From the root of the cubic Newton's method finds the pose and its place on the
// path together (event_newton.h). Where it fails, the root is bracketed by solved poses.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "genu/path/path_options.h"

namespace genu {

class LawEvents {
 public:
  /// One end of a continuation step: a solved state, and the rate of its twists (6 for each moving body) with respect
  /// to u; null where it is unknown.
  struct End {
    const State& state;
    const VecX* twist;
  };
  struct Passed {
    double u;  ///< position in the continuation step, 0 to 1
    PathEvent::Kind kind;
    std::string what;  ///< the ligament
    State state;       ///< at u; for a jump of the pose, the state at the end
  };
  /// Solves the pose at u, 0 < u < 1. False where that fails.
  using PoseAt = std::function<bool(double u, State& out)>;
  /// Solves pose and u together for a given length (m) of a ligament, from the guess u and its own guess of the pose.
  /// False where that fails.
  using EventAt = std::function<bool(int ligament, double length, double& u, State& out)>;
  /// Solvers for points between both ends. Either may be missing.
  struct Solves {
    PoseAt pose_at;
    EventAt event_at;
  };

  /// Without `locate` no break is watched.
  explicit LawEvents(const JointModel& model, bool locate = true);

  /// Whether no break is watched: the calls below then do nothing.
  bool none() const { return watched_.empty(); }

  /// m: a length closer to a break is at it.
  double rounding() const { return rounding_; }

  /// All breaks passed in a continuation step, in path order, each located to `tolerance` in u; at its end without a
  /// `pose_at` (the pose jumps). The first call takes the current sides of the ligaments; later calls continue from the
  /// end of the last one, so that no event is lost or reported twice between two steps. The result is valid until the
  /// next call.
  const std::vector<Passed>& over(const End& from, const End& to, double tolerance, const Solves& solves);

  /// The sides of their breaks that the ligaments are on.
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
  /// A point of the continuation step with known length: distance past the break (m) and its rate (m per u).
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
  double rounding_;  ///< m: a length this close to a break has not changed sides
  std::vector<Watched> watched_;
  bool begun_ = false;
  std::vector<Passed> passed_;
  State between_;
  const Solves* solves_ = nullptr;
  double tolerance_ = 0;
};

}  // namespace genu
