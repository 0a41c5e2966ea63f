// One solved pose of a path with its report, stability and events.
#pragma once

#include "genu/equilibrium/active_set.h"
#include "genu/equilibrium/stability.h"
#include "genu/equilibrium/undetermined.h"
#include "genu/model/step_plan.h"

namespace genu {

/// One row of the results.
struct PosePoint {
  int step = 0;       ///< from 1
  int increment = 0;  ///< from 0
  double t = 0;       ///< position in its step, 0 to 1
  int branch = 1;     ///< a path connects the rows of one number; where the joint jumps the next begins
  Target target;
  Balanced pose;
  PoseReport report;
  Stability stability;
  Undetermined undetermined;
  bool solved() const { return report.status == PoseStatus::ok; }
};

}  // namespace genu
