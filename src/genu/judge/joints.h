// Poses of bodies from joint coordinates, by the definitions of docs/scene-reference.md only:
//   X_parent_child = [R1 R2 R3, x],   X_world_child = X_world_parent X_parent_child
// and the motion of a child per coordinate, from differences of these poses.
#pragma once

#include <array>
#include <vector>

#include "genu/judge/results_file.h"
#include "genu/scene/scene.h"

namespace genu::judge {

/// Central differences of order 8 at 1 to 4 steps, over the step.
inline constexpr std::array kDifferenceWeights = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};

using Coordinates = std::vector<std::array<double, 6>>;  ///< of each joint: rad, then m

/// "knee.flexion_deg", "knee.x_mm": the column of a coordinate or of a combination.
std::string column_of(const Scene& scene, const QuantityRef& q);
/// SI per unit of such a column.
double column_unit(const QuantityRef& q);

/// The coordinates of a row; those held by a joint are taken from the scene. NaN for an empty cell.
Coordinates coordinates_in(const Scene& scene, const Row& row);
Coordinates reference_coordinates(const Scene& scene);

double value_of(const Scene& scene, const Coordinates& q, const QuantityRef& quantity);

/// Poses of all bodies in the world.
std::vector<Pose> poses_at(const Scene& scene, const Coordinates& q);

/// Motion of a body: velocity of its origin and angular velocity, in the world's axes.
struct Motion {
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();
};

/// Motion of a joint's child per unit (rad, m) of its coordinate `index`, all others fixed. Central differences of
/// order 8: only rounding errors, about 1e-12.
Motion motion_of(const Scene& scene, const Coordinates& q, const std::vector<Pose>& poses, int joint, int index);

/// Bodies carried by a joint: its child and everything attached to it.
std::vector<bool> carried_by(const Scene& scene, int joint);

}  // namespace genu::judge
