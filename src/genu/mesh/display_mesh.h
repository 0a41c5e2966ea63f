// A mesh with few enough triangles to be looked at. Never to be computed with: see mesh_coarsen.h for that.
#pragma once

#include "genu/mesh/mesh.h"

namespace genu {

/// The mesh itself where it has at most `most` triangles. Else vertices that lie in one cell of a grid are drawn into
/// the one of them that is nearest to their mean, and triangles without area are dropped; the cells grow until at most
/// `most` triangles are left (at least 1000 are asked for). No vertex moves by more than the diagonal of a cell.
Mesh display_mesh(Mesh mesh, std::size_t most);

}  // namespace genu
