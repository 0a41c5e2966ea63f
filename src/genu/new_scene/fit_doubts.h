// Whether the reference knee fits much better on meshes that are taken otherwise: mirrored, exchanged, or back to
// front.
#pragma once

#include <optional>
#include <vector>

#include "genu/atlas/fitted_knee.h"
#include "genu/mesh/mesh.h"
#include "genu/study/knee_layout.h"
#include "genu/study/layout_doubts.h"

namespace genu {

/// What is known of the meshes, for the atlas.
KneeAxes axes_of(const KneeLayout& knee, bool left);

/// How far the reference knee is off both meshes: the sum of its median misfits on them. m
double reference_misfit(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee, bool left);

/// Which knee it is by what the reference knee fits better, as itself or mirrored: true for a left one. Empty where
/// neither is much better.
std::optional<bool> fits_left(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee);

/// Empty where `misfit`, that of the meshes as they are taken, is small, or no other reading makes it much smaller.
std::vector<LayoutDoubt> fit_doubts(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee, double misfit);

}  // namespace genu
