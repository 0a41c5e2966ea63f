// Triangle meshes as files, by the ending of their name.
#pragma once

#include <string>

#include "genu/mesh/mesh.h"

namespace genu {

/// Binary PLY, double precision, little-endian. `title` (one line) becomes a comment. Units, replacement of an older
/// file and what is returned are those of write_stl().
[[nodiscard]] std::string write_ply(const Mesh& mesh, const std::string& path, double metres_per_unit,
                                    const std::string& title);

/// What write_ply() writes.
std::string ply_bytes(const Mesh& mesh, double metres_per_unit, const std::string& title);

/// Wavefront OBJ with as many digits as bring back the same doubles.
[[nodiscard]] std::string write_obj(const Mesh& mesh, const std::string& path, double metres_per_unit,
                                    const std::string& title);

/// Why write_mesh() could not write to `path`: a name with another ending than .stl, .ply or .obj, or something there
/// that is no regular file. Empty where it can, as far as that can be told before.
[[nodiscard]] std::string why_not_writable(const std::string& path);

/// Whether `path` is a file of write_mesh() whose title starts with `start`: the files a program may replace because it
/// wrote them itself.
bool has_title(const std::string& path, const std::string& start);

/// STL, PLY or OBJ as the name ends: .stl, .ply, .obj, in capitals too.
[[nodiscard]] std::string write_mesh(const Mesh& mesh, const std::string& path, double metres_per_unit,
                                     const std::string& title);

}  // namespace genu
