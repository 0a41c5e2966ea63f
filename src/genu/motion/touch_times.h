// When paths begin to touch surfaces, or leave them, in a motion. Their force is continuous there, so that the motion
// goes on; the times are found afterwards, by bisection of the step.
#pragma once

#include <functional>
#include <vector>

#include "genu/equilibrium/path_event.h"
#include "genu/motion/equations_of_motion.h"

namespace genu {

/// Events `wraps` and `unwraps` between two points of a motion. `at_time` gives points between; false where it fails.
std::vector<PathEvent> touches_between(const JointModel& model, const MotionPoint& before, const MotionPoint& after,
                                       const std::function<bool(double t, MotionPoint& out)>& at_time);

}  // namespace genu
