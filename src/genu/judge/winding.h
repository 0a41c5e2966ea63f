// Meshes come with patches wound inside out: the judge turns them by its own lights.
#pragma once

#include <array>
#include <vector>

#include "genu/core/types.h"

namespace genu::judge {

/// Turns triangles so that those with a common edge are wound alike, each connected piece the way most of its area was.
/// Edges of one triangle, or of more than two, connect nothing.
void align_winding(const std::vector<Vec3>& vertices, std::vector<std::array<int, 3>>& triangles);

}  // namespace genu::judge
