// Self-intersections: where triangles of a mesh run through each other. In floating point, for any set of triangles:
// quick enough to examine every mesh that is read, and the same in a build without CGAL. CGAL's exact answer is the
// twin in its test, because it needs a manifold.
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
