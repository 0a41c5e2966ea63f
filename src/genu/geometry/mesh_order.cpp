#include "genu/geometry/mesh_order.h"

#include <algorithm>
#include <numeric>

namespace genu {
namespace {

Vec3 centroid(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

/// The smallest index first; turning the corners round keeps the winding.
void turn_to_smallest(std::array<int, 3>& t) { std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end()); }

/// Compares triangles by their corners as sets first, so that a mirrored mesh, wound the other way, sorts the same.
bool before(const std::array<int, 3>& x, const std::array<int, 3>& y) {
  const auto key = [](const std::array<int, 3>& t) {
    return std::array{t[0], std::min(t[1], t[2]), std::max(t[1], t[2]), t[1]};
  };
  return key(x) < key(y);
}

}  // namespace

void sort_canonically(Mesh& mesh) {
  const Vec3 centre = centroid(mesh.vertices);
  std::vector<double> distance;
  distance.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) distance.push_back((v - centre).squaredNorm());
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
    return distance[static_cast<std::size_t>(i)] < distance[static_cast<std::size_t>(j)];
  });
  std::vector<Vec3> vertices;
  std::vector<int> rank(order.size());
  vertices.reserve(order.size());
  for (const int i : order) {
    rank[static_cast<std::size_t>(i)] = static_cast<int>(vertices.size());
    vertices.push_back(mesh.vertices[static_cast<std::size_t>(i)]);
  }
  mesh.vertices = std::move(vertices);
  for (auto& t : mesh.triangles) {
    for (int& v : t) v = rank[static_cast<std::size_t>(v)];
    turn_to_smallest(t);
  }
  std::sort(mesh.triangles.begin(), mesh.triangles.end(), before);
}

}  // namespace genu
