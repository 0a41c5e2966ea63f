// Wrenches on the bodies as generalised forces on coordinates, and what the terms of a scene do to its free
// coordinates, for solvers of somebody else's. Every moving body is the child of one joint, so there are as many
// coordinates as equations.
//
// With the gradients G of all coordinates to the twists (joint_coordinates.h) a wrench on the bodies is w = G^T Q. At
// fixed Q its derivative is that of multipliers on the coordinates, which linearize() has: so dQ/dq = G^-T (K -
// d(G^T)/dt Q) G^-1 with the stiffness K = dw/dt.
#pragma once

#include <optional>
#include <vector>

#include "genu/model/linearization.h"

namespace genu {

/// For each column of `wrenches` (6B, N and N m about the poses' origins, world axes) the moments and forces (N m, N)
/// on the six coordinates of each joint that do the same work, those that joints hold included. Of the wrench of a unit
/// tension along a path these are the path's moment arms (m; of a translation 1): -dL/dq with all other coordinates
/// constant. Empty where a joint is at its gimbal pose.
std::optional<MatX> on_coordinates(const JointModel& model, const State& state, const MatX& wrenches);

struct GeneralisedForces {
  VecX forces;       ///< N m of rotations, N of translations; positive drives the coordinate up; 0 at equilibrium
  MatX derivatives;  ///< d forces_i / d coordinate_j (rad, m)
};

/// The coordinates that no joint holds, joint by joint.
std::vector<CoordinateRef> free_coordinates(const JointModel& model);

/// Ligaments, elastic layers, loads with `load_factors` at `time` (s), weights and joint springs at the values (rad, m)
/// of the free_coordinates(); those that joints hold are where they hold them. Rigid contacts press with nothing. Empty
/// where a joint is at its gimbal pose. `memory` speeds up the next call.
std::optional<GeneralisedForces> generalised_forces(const JointModel& model, const std::vector<double>& values,
                                                    const std::vector<double>& load_factors, double time,
                                                    Linearization& memory);

}  // namespace genu
