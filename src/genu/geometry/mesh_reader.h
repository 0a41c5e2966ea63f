// Triangle meshes from files: STL (binary, ASCII), PLY, OBJ, OFF and VTP.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/geometry/mesh.h"
#include "genu/geometry/mesh_weld.h"

namespace genu {

/// What a mesh file held before its vertices were welded.
struct MeshFileFacts {
  std::size_t vertices = 0, triangles = 0;
  WeldReport weld;
  double rounding = 0;  ///< m: the step of single-precision numbers at the largest coordinate; 0 where they are finer
};

/// Reads all triangles of `path` (convex polygons are cut into fans), welds vertices within weld_tolerance(), drops
/// degenerate and repeated triangles (a warning tells how many) and turns file units into metres. Vertices keep the
/// order of their first appearance; the winding is the file's. Coordinates that single precision rounds to more than
/// 2 um, as far from the origin, get a warning.
/// Empty with an error in `out` that names the file, what is wrong and what to do, for a file that is missing, not
/// readable, of another format, empty, truncated, larger than memory, or without triangles or with coordinates that
/// are not numbers.
std::optional<Mesh> read_mesh(const std::string& path, double metres_per_unit, Diagnostics& out,
                              MeshFileFacts* facts = nullptr);

}  // namespace genu
