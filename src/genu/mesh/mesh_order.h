// One order for the vertices and triangles of a mesh, whatever order its file had them in.
#pragma once

#include "genu/mesh/mesh.h"

namespace genu {

/// Sorts vertices by their distance from the mesh's centroid and triangles by their vertices, winding kept. What is
/// built from the mesh afterwards (where nodes are placed, what fit radius is chosen) then does not depend on the order
/// in the file, nor on how the mesh lies in space: a mirrored knee gives mirrored results.
void sort_canonically(Mesh& mesh);

}  // namespace genu
