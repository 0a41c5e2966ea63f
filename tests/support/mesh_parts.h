// Meshes made of others.
#pragma once

#include <utility>

#include "genu/core/pose.h"
#include "genu/mesh/mesh.h"

namespace genu::test {

inline Mesh moved(Mesh mesh, const Pose& pose) {
  for (Vec3& v : mesh.vertices) v = pose * v;
  return mesh;
}

/// As one mesh, vertices unwelded.
inline Mesh joined(Mesh a, const Mesh& b) {
  const int offset = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + offset, j + offset, k + offset});
  return a;
}

/// Its triangles the other way round.
inline Mesh turned(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace genu::test
