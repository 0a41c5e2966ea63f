// What each triangle of an elastic layer carries: the columns of results.csv for that layer are sums over these rows.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/results/pose_table.h"

namespace genu {

/// CSV of layer k, a row for each triangle (smooth surfaces: for each node of their lattice, and each deepest point,
/// which stands for no area) that is pressed at a pose of `records`, pose after pose. `row` counts the poses as the
/// rows of results.csv, from 1; `triangle` those of the surface's mesh, from 0. Place and normal are those of the named
/// surface, which casts, in its own body; force is that on the second surface's body, in its axes. Frames as in the
/// scene's files; areas and forces hold the surface's share.
std::string pressure_map(const PlacedScene& scene, const JointModel& model, int layer,
                         const std::vector<PoseRecord>& records);

/// File names and contents of all layers: pressures_CONTACT.csv.
std::vector<std::pair<std::string, std::string>> pressure_maps(const PlacedScene& scene, const JointModel& model,
                                                               const std::vector<PoseRecord>& records);

}  // namespace genu
