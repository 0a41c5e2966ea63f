#include "genu/geometry/samples.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

namespace genu {

SampleSet vertex_samples(const Mesh& mesh) {
  SampleSet out;
  const std::size_t n = mesh.vertices.size();
  out.points = mesh.vertices;
  out.normals.assign(n, Vec3::Zero());
  out.areas.assign(n, 0.0);
  std::vector<std::pair<int, int>> edges;
  edges.reserve(6 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vec3& p = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vec3 cross = (mesh.vertices[static_cast<std::size_t>(t[1])] - p)
                           .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - p);
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(t[static_cast<std::size_t>(k)]);
      out.normals[v] += cross;
      out.areas[v] += cross.norm() / 6;
      const int next = t[static_cast<std::size_t>((k + 1) % 3)];
      edges.emplace_back(static_cast<int>(v), next);
      edges.emplace_back(next, static_cast<int>(v));
    }
  }
  for (Vec3& normal : out.normals) normal.normalize();
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  out.first_neighbour.assign(n + 1, 0);
  for (const auto& e : edges) ++out.first_neighbour[static_cast<std::size_t>(e.first) + 1];
  for (std::size_t i = 0; i < n; ++i) out.first_neighbour[i + 1] += out.first_neighbour[i];
  out.neighbours.reserve(edges.size());
  for (const auto& e : edges) out.neighbours.push_back(e.second);
  return out;
}

}  // namespace genu
