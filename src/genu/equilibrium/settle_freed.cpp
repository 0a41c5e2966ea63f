#include "genu/equilibrium/settle_freed.h"

#include <utility>

namespace genu {

PoseReport settle_freed(ActiveSetSolver& solver, Balanced& pose, const Target& target) {
  Balanced trial = pose;
  PoseReport report = solver.settle(trial, target);
  const bool ok = report.status == PoseStatus::ok;
  if (!ok || solver.passes_through(pose.state, trial.state)) {
    const int iterations = report.iterations;
    trial = pose;
    if (ok)
      while (!trial.state.contacts.empty()) solver.release(trial, 0);
    report = ok ? solver.settle_cold(trial, target) : solver.settle_from_seed(trial, target);
    report.iterations += iterations;
  }
  if (report.status == PoseStatus::ok) pose = std::move(trial);
  return report;
}

}  // namespace genu
