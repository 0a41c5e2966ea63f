#include "genu/mesh/sharp_corners.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "genu/mesh/tolerances.h"

namespace genu {
namespace {

Vec3 normal_of(const Mesh& mesh, int triangle) {
  const auto& t = mesh.triangles[at(triangle)];
  const Vec3& p = mesh.vertices[at(t[0])];
  return (mesh.vertices[at(t[1])] - p).cross(mesh.vertices[at(t[2])] - p).normalized();
}

}  // namespace

SharpCorners::SharpCorners(const Mesh& mesh, const std::vector<MeshEdge>& edges)
    : neighbours_(mesh.vertices.size()), creases_(mesh.vertices.size()) {
  for (const MeshEdge& e : edges) {
    const int a = e.v[0], b = e.v[1];
    neighbours_[at(a)].push_back(b);
    neighbours_[at(b)].push_back(a);
    if (e.count != 2 || normal_of(mesh, e.t[0]).dot(normal_of(mesh, e.t[1])) > kSharpEdgeCosine) continue;
    creases_[at(a)].push_back(b);
    creases_[at(b)].push_back(a);
  }
}

bool SharpCorners::goes_on(int from, int to) const {
  const std::vector<int>& ring = neighbours_[at(from)];
  return std::any_of(creases_[at(to)].begin(), creases_[at(to)].end(),
                     [&](int next) { return next != from && std::find(ring.begin(), ring.end(), next) == ring.end(); });
}

bool SharpCorners::is_corner(int vertex) const {
  const std::vector<int>& ends = creases_[at(vertex)];
  return std::count_if(ends.begin(), ends.end(), [&](int end) { return goes_on(vertex, end); }) >= 3;
}

}  // namespace genu
