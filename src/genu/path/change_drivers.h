// Loads that drive coordinates, from one step to the next.
#pragma once

#include <vector>

#include "genu/model/step_plan.h"

namespace genu {

/// Loads that drove a coordinate in the step `before` (null for the first step) go on in `factors` with the factor
/// found there. Of `state` the multipliers are those of `step`: loads that begin to drive are searched from the factor
/// 1, and a coordinate that gets its reaction back from none.
void change_drivers(const JointModel& model, const StepPlan* before, const StepPlan& step, State& state,
                    std::vector<double>& factors);

}  // namespace genu
