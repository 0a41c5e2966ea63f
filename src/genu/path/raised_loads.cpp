#include "genu/path/raised_loads.h"

#include <fmt/format.h>

#include "genu/path/path_turn.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

/// Follows a plan to its end, on one branch. False where the path ends before.
bool follow(PathFollower& follower, const StepPlan& plan, const Balanced& from, const PoseReport& report) {
  follower.begin(plan, 0, from, report);
  return plan.varies_nothing() || follower.advance_to(1);
}

}  // namespace

RaisedLoads raise_loads(ActiveSetSolver& solver, const PathOptions& options, const StepPlan& approach,
                        const StepPlan& step, const Balanced& start) {
  RaisedLoads out;
  if (solver.model().layers.empty()) return out;
  PathOptions quiet = options;
  quiet.locate_law_breaks = false;
  quiet.smallest_increment = kLoadIncrement;
  const std::function<void(PathEvent)> nobody = [](const PathEvent&) {};
  for (const double part : kFirstParts) {
    StepPlan there = approach, raise = step;  // to the first values of the step; from there on
    for (auto& f : there.factors) f = {part * f.to, part * f.to};
    for (auto& p : raise.prescribed) p.to = p.from;
    for (auto& f : raise.factors) f = {part * f.from, f.from};
    raise.increments = 1;
    raise.arc_length = false;
    raise.end_time = raise.start_time;
    if (raise.varies_nothing() || asked_to_stop(options.newton.cancelled)) return out;
    Balanced pose = start;
    PoseReport report = solver.settle_cold(pose, there.target(0));
    out.iterations += report.iterations;
    if (report.status != PoseStatus::ok) continue;
    PathFollower follower(solver, quiet, nobody);
    bool arrived = follow(follower, there, pose, report);
    out.borne = part;
    if (arrived) {
      pose = follower.pose();
      report = follower.report();
      arrived = follow(follower, raise, pose, report);
      out.borne = arrived ? 1 : part + (1 - part) * follower.t();
      if (!arrived) {
        PathTurn turn = find_turn(solver, quiet, follower, raise, 0);
        out.iterations += turn.iterations;
        if (turn.event) out.borne = part + (1 - part) * turn.event->t;
        out.turn = std::move(turn.event);
      }
    }
    out.pose = follower.pose();
    out.report = arrived ? follower.report() : follower.failure();
    out.substeps = follower.substeps();
    out.iterations += follower.iterations();
    if (out.turn) {
      out.report.status = PoseStatus::no_equilibrium;
      out.report.why = fmt::format("the path turns back under {:.4g} of the loads", out.borne);
    }
    return out;
  }
  return out;
}

}  // namespace genu
