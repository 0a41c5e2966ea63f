// From what a scene says about a surface to the surface itself.
#pragma once

#include <memory>

#include "genu/scene/scene.h"
#include "genu/surface/surface.h"

namespace genu {

/// The surface in the frame of its body (m). Null for a mesh, and for sizes that make no surface (see
/// surface/analytic.h), which the scene's reader has refused already.
std::unique_ptr<Surface> make_analytic_surface(const SurfaceDef& def);

/// `surface`, built from `def`, or the part of it in the patch of `def`; null where the patch holds no part of it.
std::shared_ptr<const Surface> within_patch(std::shared_ptr<const Surface> surface, const SurfaceDef& def);

}  // namespace genu
