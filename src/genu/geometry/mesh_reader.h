// Triangle meshes from files: STL (binary, ASCII), PLY and OBJ, through assimp.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/geometry/mesh.h"

namespace genu {

/// Reads all triangles of `path` (convex polygons are cut into fans), welds vertices within weld_tolerance(), drops
/// degenerate and repeated triangles (a warning tells how many) and turns file units into metres. Vertices keep the
/// order of their first appearance; the winding is the file's.
/// Empty with an error in `out` that names the file, what is wrong and what to do, for a file that is missing, not
/// readable, of another format, empty, truncated, larger than memory, or without triangles or with coordinates that
/// are not numbers.
std::optional<Mesh> read_mesh(const std::string& path, double metres_per_unit, Diagnostics& out);

}  // namespace genu
