// The point of a triangle, or of a mesh, that is nearest to a place.
#pragma once

#include <cstddef>

#include "genu/mesh/mesh.h"

namespace genu {

/// Of the triangle a, b, c (Ericson 2005, 5.1.5).
Vec3 nearest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// m; x where the mesh has no triangle. Looks at all of them. `triangle` (may be null) becomes the one that has it.
Vec3 nearest_on_mesh(const Mesh& mesh, const Vec3& x, std::size_t* triangle = nullptr);

}  // namespace genu
