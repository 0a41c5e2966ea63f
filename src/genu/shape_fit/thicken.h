// An open sheet as the outer face of a closed solid: for programs that want watertight meshes.
#pragma once

#include <string>

#include "genu/mesh/mesh.h"
#include "genu/surface/surface.h"

namespace genu {

/// The sheet, cut from `surface`, a copy of it `thickness` (m) behind it along the surface's normals, and walls of
/// triangles about `edge` (m) long between their borders; normals point out of the solid. A closed mesh stays as it is.
/// Empty, with the reason in `why`, where the copy would fold: behind a surface that bulges outward with a smallest
/// radius of less than the thickness.
Mesh thicken(const Mesh& sheet, const Surface& surface, double thickness, double edge, std::string& why);

}  // namespace genu
