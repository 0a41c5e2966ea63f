// What the geometry of a layer gives reason to doubt: surfaces that face the same way, surfaces that have gone through
// a shell, contact that runs over a surface's rim, thickness that nobody has measured, and contact smaller than
// triangles.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

/// A sentence for each layer whose surfaces face the same way where they are nearest: one of the two is inside out. Of
/// the first of `states` in which the surfaces are near.
std::vector<std::string> facing_doubts(const Prepared& prepared, const std::vector<const State*>& states);

/// A sentence for each layer of which one surface has gone through the whole of the other body, as a shell of cartilage
/// that is thinner than the overlap: what lies beyond carries no load. Of the worst of `states`.
std::vector<std::string> passed_doubts(const Prepared& prepared, const std::vector<const State*>& states);

/// A sentence for each surface at whose rim a layer is under pressure, which ends there because the surface does, and
/// for each layer that presses on cartilage whose thickness was filled in, with the rows of `records` (from 1).
std::vector<std::string> footing_doubts(const Prepared& prepared, const std::vector<PoseRecord>& records);

/// A sentence for each layer whose force misses its tolerance at the finest quadrature, with the rows of `records`.
std::vector<std::string> tolerance_doubts(const Prepared& prepared, const std::vector<PoseRecord>& records);

}  // namespace genu
