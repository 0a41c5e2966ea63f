// Polygons cut into triangles. A fan about the first corner is right for a convex polygon, and for one that the first
// corner sees all of; any other is cut ear by ear (G. H. Meisters 1975) in its mean plane.
#pragma once

#include <cstddef>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

/// The triangles of a polygon of more than three corners: they stand one after the other in a mesh, and share the
/// polygon's first corner.
struct Fan {
  std::size_t first = 0, triangles = 0;
};

/// Adds a polygon of three or more corners to the mesh, as a fan; `fans` lists it where it is more than a triangle.
void add_polygon(const std::vector<int>& corners, Mesh& mesh, std::vector<Fan>& fans);

/// Cuts the polygons anew for which a fan is wrong, in place: the number of triangles stays. For a mesh that has all
/// its vertices. Returns how many stay fans because they cross themselves or have more corners than
/// kMaxEarCorners.
[[nodiscard]] std::size_t cut_concave(Mesh& mesh, const std::vector<Fan>& fans);

}  // namespace genu
