// Detects non-unique poses and statically indeterminate forces.
#pragma once

#include "genu/equilibrium/pose_point.h"

namespace genu {

/// Examines a solved pose and its stability. Where the pose or its forces are not unique: false, with
/// PoseStatus::undetermined, the reason, and PosePoint::undetermined. Without Safeguard::uniqueness it returns true at
/// once. `solver` has solved that pose or one beside it.
bool judge_uniqueness(ActiveSetSolver& solver, PosePoint& point);

/// Stability of a solved pose, unilateral parts included.
Stability stability_of(ActiveSetSolver& solver, const Balanced& pose, const PoseReport& report, const Target& target);

}  // namespace genu
