#include "genu/path/path_turn.h"

#include <cmath>

#include "genu/path/arc_length_follower.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

constexpr const char* kTurnsBack = "the path turns back before this pose";

PathEvent turn_at(const StepPlan& plan, int step, double t, const State& state) {
  constexpr const char* kWhat = "no equilibrium beyond: the prescribed path turns back here";
  return {PathEvent::Kind::turns_back, step, t, plan.target(t), kWhat, state.coordinates};
}

/// Where the stiffness vanishes: the limit point, located by arc length if possible, else the last pose. None where the
/// path is nearly vertical and continues.
void turn_without_stiffness(ActiveSetSolver& solver, const PathOptions& options, PathFollower& from,
                            const StepPlan& plan, int step, PathTurn& out) {
  ArcLengthFollower follower(solver, options, from.law_events(), {});
  const auto limit = follower.limit_ahead(plan, from.pose(), from.t(), kLimitReach);
  out.iterations = follower.iterations();
  if (limit)
    out.event = turn_at(plan, step, limit->at.t, limit->at.pose.state);
  else if (!(follower.here().at.t > from.t() + options.smallest_increment))
    out.event = turn_at(plan, step, from.t(), from.pose().state);
  out.why = out.event ? kTurnsBack : "the path is too steep before this pose; control = \"arc_length\" may follow it";
}

/// The stiffness of layers and of loads that follow a body is unsymmetric: its symmetric part need not vanish where the
/// path turns back.
void turn_close_by(ActiveSetSolver& solver, const PathOptions& options, PathFollower& from, const StepPlan& plan,
                   int step, PathTurn& out) {
  ArcLengthFollower follower(solver, options, from.law_events(), {});
  const auto limit = follower.limit_ahead(plan, from.pose(), from.t(), kLimitReach);
  out.iterations = follower.iterations();
  if (!limit || std::abs(limit->at.t - from.t()) > kNearTurn * options.smallest_increment) return;
  out.event = turn_at(plan, step, limit->at.t, limit->at.pose.state);
  out.why = kTurnsBack;
}

/// Contacts that open and close without end: a nonsmooth fold.
void turn_at_contacts(ActiveSetSolver& solver, const PathOptions& options, PathFollower& from, const StepPlan& plan,
                      int step, PathTurn& out) {
  ArcLengthFollower follower(solver, options, from.law_events(), {{}, {}, options.newton.cancelled});
  const auto turn = follower.turn_at_a_change(plan, from.pose(), from.report(), from.t());
  out.iterations = follower.iterations();
  if (!turn) return;
  out.event = turn_at(plan, step, turn->at.t, turn->at.pose.state);
  out.why = kTurnsBack;
}

}  // namespace

PathTurn find_turn(ActiveSetSolver& solver, const PathOptions& options, PathFollower& follower, const StepPlan& plan,
                   int step) {
  PathTurn out;
  if (follower.turning_back())
    turn_without_stiffness(solver, options, follower, plan, step, out);
  else if (follower.failure().status == PoseStatus::chatter)
    turn_at_contacts(solver, options, follower, plan, step, out);
  else if (follower.failure().status == PoseStatus::no_equilibrium)
    turn_close_by(solver, options, follower, plan, step, out);
  return out;
}

}  // namespace genu
