// STL files.
#pragma once

#include <string>

#include "genu/mesh/mesh.h"

namespace genu {

/// How far (m) the float32 of binary STL in units of `metres_per_unit` (0.001 for mm) moves a vertex at most.
double binary_stl_rounding(const Mesh& mesh, double metres_per_unit);

/// Whether that is little enough: at most 1 um and a twentieth of the shortest edge. Meshes far from their origin are
/// refused by that.
bool fits_binary_stl(const Mesh& mesh, double metres_per_unit);

/// Writes the mesh in units of `metres_per_unit` as STL: binary where that holds its coordinates, else ASCII with as
/// many digits as bring back the same doubles. `title` (one line; cut at 79 characters in a binary file) stands in
/// front. Written whole or not at all, as write_file_atomically() does.
/// Returns an empty text on success, else what went wrong.
[[nodiscard]] std::string write_stl(const Mesh& mesh, const std::string& path, double metres_per_unit,
                                    const std::string& title);

}  // namespace genu
