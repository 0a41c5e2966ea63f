// Lengths of a scene compared with the sizes of its surfaces: warnings where a unit is probably wrong.
#pragma once

#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/core/pose.h"
#include "genu/scene/scene.h"

namespace genu {

/// Warns about ligaments that are far longer or shorter than the surfaces are large, and about a scene whose lengths
/// are all a thousand times those of its meshes, or a thousandth. `poses`: of its bodies at the
/// joints' reference; `meshes`: m across the largest one, 0 for none.
void warn_unlikely_lengths(const PlacedScene& scene, const std::vector<Pose>& poses, double meshes, Diagnostics& out);

}  // namespace genu
