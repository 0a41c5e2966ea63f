// Where the triangles of a mesh run through each other, in floating point, for any soup of triangles: quick enough to
// look at every mesh that is read. mesh_intersections.h decides the same exactly, for manifolds and with CGAL.
#pragma once

#include <utility>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

/// Pairs (i < j) of triangles that meet in more than the vertices they share, ascending. Touching counts as meeting, to
/// the rounding of the coordinates. Triangles without area are left out. At most `most` pairs are listed: a mesh that
/// has more is no surface.
std::vector<std::pair<int, int>> crossing_triangles(const Mesh& mesh, std::size_t most = 1'000'000);

}  // namespace genu
