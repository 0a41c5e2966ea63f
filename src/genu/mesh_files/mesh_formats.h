// Readers of mesh file formats, one .cpp each: from the bytes of a file to what it holds: coordinates in its own unit,
// vertices as often as it repeats them, polygons cut into triangles. What is wrong with a file comes back as text, with
// the line where there are lines; the empty text is success, and a mesh without triangles is none of their business.
// One rule for all formats: numbers that are not needed are not parsed; where the size tells how much there is, it is
// believed; anything else that differs from the format, and leaves the surface clear, is a note; a file that holds less
// than it promises is refused.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "genu/mesh/mesh.h"
#include "genu/mesh_files/mesh_notes.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {

/// STL, ASCII (mesh_stl.cpp) or binary (stl_binary.h). A binary file whose size fits its count of triangles is binary
/// whatever its title says. In an ASCII file only normals and names may be anything: parsers that skip what they do not
/// know lose triangles.
[[nodiscard]] std::string read_stl(std::string_view bytes, Mesh& mesh, MeshNotes& notes);

/// OFF, ASCII (mesh_off.cpp): "OFF" with any of the prefixes ST, C, N and 4, counts, vertices, faces; texture, colours
/// and normals are passed over.
[[nodiscard]] std::string read_off(std::string_view bytes, Mesh& mesh, MeshNotes& notes);

/// VTP, VTK's XML for polygons (mesh_vtp.cpp): polygons and strips of all pieces; numbers as text, base64 or raw,
/// inline or appended, of either byte order, plain or compressed by zlib.
[[nodiscard]] std::string read_vtp(std::string_view bytes, Mesh& mesh, MeshNotes& notes);

/// PLY, ASCII or binary of either byte order (mesh_ply.cpp): faces and triangle strips; other elements and properties
/// are passed over.
[[nodiscard]] std::string read_ply(std::string_view bytes, Mesh& mesh, MeshNotes& notes);

/// Wavefront OBJ (mesh_obj.cpp): v and f lines.
[[nodiscard]] std::string read_obj(std::string_view bytes, Mesh& mesh, MeshNotes& notes);

/// What assimp reads and genu has no reader of its own for (mesh_assimp.cpp): the meshes of a scene graph in its root's
/// frame. assimp keeps coordinates in single precision. `path` tells the format by its ending, and where files lie that
/// the mesh's own file names.
[[nodiscard]] std::string read_by_assimp(const std::string& path, std::string_view bytes, Mesh& mesh, MeshNotes& notes);
inline constexpr const char* kByAssimp[] = {".3ds", ".amf", ".dae", ".glb", ".gltf"};

inline bool is_coordinate(double x) { return std::abs(x) <= kMaxCoordinate; }  // false for nan

/// What a coordinate has to be, for messages.
inline constexpr const char* kCoordinate = "a coordinate (finite, at most 1e9)";

}  // namespace genu
