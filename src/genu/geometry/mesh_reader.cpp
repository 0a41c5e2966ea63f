#include "genu/geometry/mesh_reader.h"

#include <exception>
#include <limits>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "genu/geometry/mesh_file_check.h"
#include "genu/geometry/mesh_weld.h"

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

// Empty text where all is well.
std::string import(const std::string& path, Mesh& mesh) {
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

}  // namespace

std::optional<Mesh> read_mesh(const std::string& path, double metres_per_unit, Diagnostics& out) {
  const MeshFileCheck check = check_mesh_file(path);
  if (!check.problem.empty()) {
    out.error(path, check.problem);
    return std::nullopt;
  }
  Mesh mesh;
  std::string problem = import(path, mesh);
  if (problem.empty() && mesh.triangles.size() < check.least_triangles) {
    problem = "promises " + std::to_string(check.least_triangles) + " faces but holds " +
              std::to_string(mesh.triangles.size()) + " triangles: it is truncated; copy or export it again";
  }
  if (problem.empty() && mesh.empty()) problem = "has no triangles: export the surface as a triangle mesh";
  const WeldReport report = problem.empty() ? weld(mesh, weld_tolerance(mesh)) : WeldReport{};
  if (problem.empty() && mesh.empty()) {
    problem = "has triangles without extent only: all its points are one; check the export's number format";
  }
  if (!problem.empty()) {
    out.error(path, problem);
    return std::nullopt;
  }
  if (report.degenerate + report.duplicate > 0) {
    out.add({.severity = Diagnostic::Severity::warning,
             .file = path,
             .key = {},
             .found = {},
             .rule = "dropped " + std::to_string(report.degenerate) + " triangles without extent and " +
                     std::to_string(report.duplicate) + " repeated ones"});
  }
  for (Vec3& v : mesh.vertices) v *= metres_per_unit;
  return mesh;
}

}  // namespace genu
