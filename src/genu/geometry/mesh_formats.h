// Readers of mesh file formats, one .cpp each. They give what the file holds: coordinates in its own unit, vertices as
// often as it repeats them, polygons cut into fans. What is wrong with a file comes back as text, with the line where
// there are lines; the empty text is success, and a mesh without triangles is none of their business.
#pragma once

#include <string>

#include "genu/geometry/mesh.h"

namespace genu {

/// STL, binary or ASCII (mesh_stl.cpp). A binary file whose size fits its count of triangles is binary whatever its
/// title says. Every word of an ASCII file is looked at: parsers that skip what they do not know lose triangles.
std::string read_stl(const std::string& path, Mesh& mesh);

/// OFF, ASCII (mesh_off.cpp): "OFF", counts, vertices, faces; normals and colours are passed over.
std::string read_off(const std::string& path, Mesh& mesh);

/// VTP, VTK's XML for polygons (mesh_vtp.cpp): polygons and strips of all pieces; numbers as text, base64 or raw,
/// inline or appended, of either byte order, plain or compressed by zlib.
std::string read_vtp(const std::string& path, Mesh& mesh);

/// PLY and OBJ (mesh_assimp.cpp).
std::string read_by_assimp(const std::string& path, Mesh& mesh);

/// The words of an ASCII PLY's body or of an OBJ's v and f lines that are no numbers: assimp reads them as 0. The first
/// one found, with its line; empty where there is none.
std::string check_numbers(const std::string& path);

}  // namespace genu
