// A first pose where none is found under all loads at once: it is found under a part of them, which is then raised.
// With elastic layers a load that is much larger than what the start balances presses one body through the other.
#pragma once

#include <optional>
#include <vector>

#include "genu/path/path_options.h"

namespace genu {

struct RaisedLoads {
  /// Of all loads: under which the last pose balances. 0 where none was found under kFirstParts, nor looked for:
  /// without layers, or without loads.
  double borne = 0;
  PoseReport report;                   ///< of the pose under all loads; else why the path to it ends
  Balanced pose;                       ///< at the first values of the step; the last one of the path
  std::optional<PathEvent> turn = {};  ///< where the path turns back
  std::vector<PathEvent> events = {};  ///< on the way to all of them, of step 0
  bool all = false;                    ///< all are borne: the pose is a solution at the first values of the step
  int substeps = 0, iterations = 0;
};

/// From `start`, which was never solved. `approach`: of the joint to the first values of `step`.
RaisedLoads raise_loads(ActiveSetSolver& solver, const PathOptions& options, const StepPlan& approach,
                        const StepPlan& step, const Balanced& start);

}  // namespace genu
