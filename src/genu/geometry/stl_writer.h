// Binary STL files.
#pragma once

#include <string>

#include "genu/geometry/mesh.h"

namespace genu {

/// Writes the mesh in units of `metres_per_unit` (0.001 for mm) as binary STL, float32 as the format wants, `title`
/// (ASCII, cut at 79 characters) in its header. The file is written under another name and renamed when all of it has
/// reached the disk: `path` is the old file or the new one, never half of it.
/// Returns an empty text on success, else what went wrong.
std::string write_stl(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title);

}  // namespace genu
