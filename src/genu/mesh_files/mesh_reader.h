// Triangle meshes from files: STL (binary, ASCII), PLY, OBJ, OFF and VTP.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/mesh/mesh.h"
#include "genu/mesh/mesh_weld.h"

namespace genu {

/// What a mesh file held before its vertices were welded.
struct MeshFileFacts {
  std::size_t vertices = 0, triangles = 0;
  WeldReport weld;
  double rounding = 0;  ///< m: the step of its numbers (coordinate_step.h); 0: double precision, or too few to tell
  bool single = false;  ///< that is float32's step at the largest coordinate, not one the exporter chose
};

/// Reads all triangles of `path` (convex polygons are cut into fans), welds vertices within weld_tolerance(), drops
/// degenerate and repeated triangles (a warning tells how many) and turns file units into metres. Vertices keep the
/// order of their first appearance; the winding is the file's. Coordinates that single precision rounds to more than
/// 2 um, as far from the origin, get a warning.
/// Empty with an error in `out` that names the file, what is wrong and what to do, for a file that is missing, not
/// readable, of another format, empty, truncated, larger than memory, or without triangles or with coordinates that
/// are not numbers or lie beyond 1e9 units.
std::optional<Mesh> read_mesh(const std::string& path, double metres_per_unit, Diagnostics& out,
                              MeshFileFacts* facts = nullptr);

/// The same for a file whose unit nobody says: m where that alone makes it a knee's surface, else mm.
/// `metres_per_unit` gets it.
std::optional<Mesh> read_mesh_of_some_unit(const std::string& path, double& metres_per_unit, Diagnostics& out,
                                           MeshFileFacts* facts = nullptr);

}  // namespace genu
