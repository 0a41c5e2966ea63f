// Where a mesh runs through itself: a flaw that no look at its edges shows, and that makes "inside" meaningless there.
// Answered by CGAL's exact predicates; the rest of genu neither needs CGAL nor this.
#pragma once

#include <cstddef>
#include <optional>

#include "genu/mesh/mesh.h"

namespace genu {

/// False where genu was built with GENU_WITH_CGAL=OFF.
bool built_with_cgal();

/// Pairs of triangles that meet in more than the edge or vertex they share, decided exactly on the coordinates given
/// (CGAL, Polygon Mesh Processing: self_intersections). Triangles without area are left out; check_mesh() counts them.
/// The winding does not matter. Empty without CGAL, and where the triangles make no manifold: an edge of more than two
/// triangles, sheets that touch in a vertex, a Moebius strip, an index or coordinate that cannot be used.
std::optional<std::size_t> count_self_intersections(const Mesh& mesh);

}  // namespace genu
