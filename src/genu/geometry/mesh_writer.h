// Triangle meshes as files, by the ending of their name.
#pragma once

#include <string>

#include "genu/geometry/mesh.h"

namespace genu {

/// Binary PLY, double precision, little-endian. `title` (one line) becomes a comment. Units, replacement of an older
/// file and what is returned are those of write_stl().
std::string write_ply(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title);

/// Wavefront OBJ with as many digits as bring back the same doubles.
std::string write_obj(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title);

/// STL (binary, float32), PLY or OBJ as the name ends: .stl, .ply, .obj.
std::string write_mesh(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title);

}  // namespace genu
