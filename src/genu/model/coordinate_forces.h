// Wrenches on the moving bodies as generalised forces on the coordinates of the joints, by virtual work: every moving
// body is the child of one joint, so there are as many coordinates as equations.
#pragma once

#include <optional>

#include "genu/model/joint_model.h"
#include "genu/model/state.h"

namespace genu {

/// For each column of `wrenches` (6B, N and N m about the poses' origins, world axes) the moments and forces (N m, N)
/// on the six coordinates of each joint that do the same work, those that joints hold included. Of the wrench of a unit
/// tension along a path these are the path's moment arms (m; of a translation 1): -dL/dq with all other coordinates
/// constant. Empty where a joint is at its gimbal pose.
std::optional<MatX> on_coordinates(const JointModel& model, const State& state, const MatX& wrenches);

}  // namespace genu
