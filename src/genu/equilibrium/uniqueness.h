// Detects non-unique poses and statically indeterminate forces.
#pragma once

#include "genu/equilibrium/pose_point.h"

namespace genu {

/// Looks at a solved pose and its stability; where it or its forces are not determined, PoseStatus::undetermined, why,
/// and what (PosePoint::undetermined). False then. `solver` is where it has solved that pose, or one beside it.
bool judge_uniqueness(ActiveSetSolver& solver, PosePoint& point);

/// Stability of a solved pose, unilateral parts included.
Stability stability_of(ActiveSetSolver& solver, const Balanced& pose, const PoseReport& report, const Target& target);

}  // namespace genu
