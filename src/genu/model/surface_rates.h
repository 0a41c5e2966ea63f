// Sensitivity of a surface to its own parameters.
#pragma once

#include "genu/contact/surface_change.h"
#include "genu/model/parameters.h"

namespace genu {

/// The change of a surface at one of its points (frame of its body) per SI unit of one of its own parameters.
SurfaceChange surface_change(const SurfaceDef& def, const Parameter& parameter, const SurfacePoint& point);

}  // namespace genu
