// What the geometry of a layer gives reason to doubt: surfaces that face the same way, rays that reach through, contact
// that runs over a surface's rim, and thickness that nobody has measured.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

/// A sentence for each layer whose surfaces face the same way where they are nearest: one of the two is inside out. Of
/// the first of `states` in which the surfaces are near.
std::vector<std::string> facing_doubts(const Prepared& prepared, const std::vector<const State*>& states);

/// A sentence for each layer with rays that carry load though they enter the other body before they leave it: what they
/// measure is no overlap, but the far side of something thinner than `search_depth`. Of the worst of `states`.
std::vector<std::string> reach_doubts(const Prepared& prepared, const std::vector<const State*>& states);

/// A sentence for each surface at whose rim a layer is under pressure, which ends there because the surface does, and
/// for each layer that presses on cartilage whose thickness was filled in, with the rows of `records` (from 1).
std::vector<std::string> footing_doubts(const Prepared& prepared, const std::vector<PoseRecord>& records);

}  // namespace genu
