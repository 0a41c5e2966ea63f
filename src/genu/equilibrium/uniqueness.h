// A pose that is one of many, or forces that are, are no answer: said, not sold as one.
#pragma once

#include "genu/equilibrium/pose_point.h"

namespace genu {

/// Looks at a solved pose and its stability; where it or its forces are not determined, PoseStatus::undetermined, why,
/// and what (PosePoint::undetermined). False then. `solver` is where it has solved that pose, or one beside it.
bool judge_uniqueness(ActiveSetSolver& solver, PosePoint& point);

/// Of a solved pose, what holds one way only looked at the other way too.
Stability stability_of(ActiveSetSolver& solver, const Balanced& pose, const PoseReport& report, const Target& target);

}  // namespace genu
