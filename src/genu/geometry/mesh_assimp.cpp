#include <cctype>
#include <exception>
#include <fstream>
#include <iterator>
#include <limits>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "genu/geometry/mesh_formats.h"
#include "genu/geometry/text_words.h"

namespace genu {
namespace {

// Positions and triangles alone: a normal or texture coordinate that differs never parts two corners, so none of
// assimp's own joining (which keeps STL torn along its facet normals) is needed. Empty text where all is well.
std::string append(const aiMesh& part, Mesh& mesh) {
  const std::size_t base = mesh.vertices.size();
  if (base + part.mNumVertices > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    return "has more vertices than can be counted: reduce the mesh";
  }
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D& p = part.mVertices[v];
    mesh.vertices.emplace_back(p.x, p.y, p.z);
    if (!mesh.vertices.back().allFinite()) {
      return "has a coordinate that is not a finite number (vertex " + std::to_string(base + v + 1) +
             "): repair or export the mesh again";
    }
  }
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= part.mNumVertices)
        return "has a face that names a vertex it does not have: export it again";
    }
    const auto corner = [&](unsigned k) { return static_cast<int>(base + face.mIndices[k]); };
    // Points and lines are not a surface; a polygon becomes a fan.
    for (unsigned k = 2; k < face.mNumIndices; ++k) mesh.triangles.push_back({corner(0), corner(k - 1), corner(k)});
  }
  return {};
}

/// An OBJ's line: a vertex needs three numbers, each corner of a face starts with one.
std::string check_obj_line(std::string_view line) {
  TextWords words(line, '#');
  const std::string_view kind = words.next();
  if (kind != "v" && kind != "f") return {};
  int count = 0;
  for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count) {
    double x = 0;
    int corner = 0;
    const bool good =
        kind == "v" ? TextWords::number(word, x) : TextWords::number(word.substr(0, word.find('/')), corner);
    if (!good) return "has " + in_quotes(word) + " where a number should stand";
  }
  return count < 3 ? "has fewer than three numbers" : "";
}

}  // namespace

std::string check_numbers(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const bool obj = path.size() > 4 && std::tolower(static_cast<unsigned char>(path[path.size() - 3])) == 'o';
  std::string line;
  bool body = obj, ascii = obj;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    std::string problem;
    if (!body) {
      ascii = ascii || line.starts_with("format ascii");
      body = line.starts_with("end_header");
      if (body && !ascii) return {};
    } else if (obj) {
      problem = check_obj_line(line);
    } else {
      TextWords words(line);
      for (std::string_view word = words.next(); !word.empty() && problem.empty(); word = words.next())
        if (double x = 0; !TextWords::number(word, x))
          problem = "has " + in_quotes(word) + " where a number should stand";
    }
    if (!problem.empty())
      return "in line " + std::to_string(number) + " " + problem + ": it is damaged; export it again";
  }
  return {};
}

std::string read_by_assimp(const std::string& path, Mesh& mesh) {
  try {
    Assimp::Importer importer;
    // No post-processing: assimp's triangulation aborts the program on some broken files (5.2.5).
    const aiScene* scene = importer.ReadFile(path, 0);
    if (scene == nullptr) {
      return std::string("cannot be read as a mesh (") + importer.GetErrorString() + "): export it again as binary STL";
    }
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
      if (std::string problem = append(*scene->mMeshes[m], mesh); !problem.empty()) return problem;
    }
  } catch (const std::exception& e) {  // assimp's own parsers may throw on a broken file, and memory may run out
    return std::string("cannot be read as a mesh (") + e.what() + "): export it again as binary STL";
  }
  return {};
}

}  // namespace genu
