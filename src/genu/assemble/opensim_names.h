// The names that OpenSim's users give to coordinates, and what they mean in a scene: JOINT_QUANTITY or
// JOINT_QUANTITY_SIDE, alone or at the end of a path such as /jointset/knee_r/knee_flex_r/value.
#pragma once

#include <string>
#include <vector>

#include "genu/scene/scene.h"

namespace genu {

/// knee_flex_r of /jointset/knee_r/knee_flex_r/value; empty for the path of a speed.
std::string last_part_of_path(const std::string& column);

/// The coordinates that a column may mean, in the scene's order: knee_flex_r is the rotation of joint `knee` (or
/// `knee_r`) whose name begins with "flex" (three letters at least), knee_tx_r its translation `x` or `tx`.
std::vector<CoordinateRef> opensim_coordinates(const SceneTables& scene, const std::string& column);

}  // namespace genu
