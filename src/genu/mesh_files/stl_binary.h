// Binary STL: 80 bytes of title, a count of triangles, and 50 bytes for each (normal, corners, attribute).
#pragma once

#include <string>
#include <string_view>

#include "genu/mesh/mesh.h"
#include "genu/mesh_files/mesh_notes.h"

namespace genu {

/// Whether the size is what the count of triangles asks for: then the file is binary whatever its title says.
bool fits_binary_stl(std::string_view bytes);

/// Reads what fits_binary_stl(), and what differs from it so little that all triangles are there: a count of 0 or
/// 0xFFFFFFFF (not filled in) where the size tells the true one, bytes after the last triangle, several files in one
/// (each with a note), attributes that say how many bytes follow each triangle. Else returns what is wrong.
[[nodiscard]] std::string read_binary_stl(std::string_view bytes, Mesh& mesh, MeshNotes& notes);

}  // namespace genu
