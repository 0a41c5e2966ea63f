// Meshes may have patches with inverted winding: the judge corrects them with its own method.
#pragma once

#include <array>
#include <vector>

#include "genu/core/types.h"

namespace genu::judge {

/// Turns triangles so that neighbours across an edge have the same winding, and each connected piece that of most of
/// its area. Edges of one triangle, or of more than two, connect nothing.
void align_winding(const std::vector<Vec3>& vertices, std::vector<std::array<int, 3>>& triangles);

/// Turns a mesh that closes (two triangles at every edge) round where it encloses a negative volume: it is inside out.
void turn_closed_outward(const std::vector<Vec3>& vertices, std::vector<std::array<int, 3>>& triangles);

}  // namespace genu::judge
