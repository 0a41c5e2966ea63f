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

/// From the pose at the step's first values under `part` of the loads to all of them. What it finds is kept where it
/// bears more than what `out` has.
void raise_from_there(ActiveSetSolver& solver, const PathOptions& options, const StepPlan& raise, double part,
                      const Balanced& pose, const PoseReport& report, PathFollower& follower, RaisedLoads& out) {
  const bool all = follow(follower, raise, pose, report);
  std::optional<PathEvent> turn;
  if (!all) {
    PathTurn found = find_turn(solver, options, follower, raise, 0);
    out.iterations += found.iterations;
    if (found.event && found.event->t < 1) turn = std::move(found.event);
  }
  const double reached = all ? 1 : (turn ? turn->t : follower.t()), borne = part + (1 - part) * reached;
  if (!all && borne <= out.borne) return;
  out.all = all;
  out.borne = borne;
  out.pose = follower.pose();
  out.report = all ? follower.report() : follower.failure();
  out.turn = std::move(turn);
  if (!out.turn) return;
  out.report.status = PoseStatus::no_equilibrium;
  out.report.why = fmt::format("the path turns back under {:.4g} of the loads at the start", borne);
}

}  // namespace

RaisedLoads raise_loads(ActiveSetSolver& solver, const PathOptions& options, const StepPlan& approach,
                        const StepPlan& step, const Balanced& start) {
  RaisedLoads out;
  if (solver.model().layers.empty()) return out;
  PathOptions quiet = options;
  quiet.locate_law_breaks = false;
  quiet.smallest_increment = kLoadIncrement;
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
    std::vector<PathEvent> events;
    PathFollower follower(solver, quiet, [&](PathEvent event) { events.push_back(std::move(event)); });
    const bool arrived = follow(follower, there, pose, report);
    if (arrived) {
      pose = follower.pose();
      report = follower.report();
      raise_from_there(solver, quiet, raise, part, pose, report, follower, out);
    }
    out.substeps += follower.substeps();
    out.iterations += follower.iterations();
    if (out.all) out.events = std::move(events);
    if (out.all || out.turn) return out;
  }
  return out;
}

}  // namespace genu
