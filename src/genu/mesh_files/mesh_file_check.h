// What can be said about a mesh file before a parser sees it: parsers accept half a file, or ask for all memory.
#pragma once

#include <cstddef>
#include <string>

namespace genu {

struct MeshFileCheck {
  std::string problem;              ///< what is wrong and what to do; empty where nothing is
  std::size_t least_triangles = 0;  ///< that the header of a binary STL promises; 0 where unknown
};

/// Is there a regular file of a known format, neither empty nor truncated (as far as its format tells) nor larger than
/// this computer's memory?
MeshFileCheck check_mesh_file(const std::string& path);

}  // namespace genu
