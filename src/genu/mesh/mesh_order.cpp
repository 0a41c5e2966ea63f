#include "genu/mesh/mesh_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace genu {
namespace {

/// An order that only the places themselves decide, and that a mirror in a coordinate plane keeps where it can.
bool before_in_space(const Vec3& x, const Vec3& y) {
  const auto key = [](const Vec3& v) {
    return std::array{std::abs(v.x()), std::abs(v.y()), std::abs(v.z()), v.x(), v.y(), v.z()};
  };
  return key(x) < key(y);
}

Vec3 centroid(const std::vector<Vec3>& points, const std::vector<int>& order) {
  Vec3 sum = Vec3::Zero();
  for (const int i : order) sum += points[static_cast<std::size_t>(i)];
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
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto vertex = [&](int i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return before_in_space(vertex(i), vertex(j)); });
  // Equal distances (a sphere, a square) keep this order; it also makes the sum, and so the centroid, the file's no
  // more.
  const Vec3 centre = centroid(mesh.vertices, order);
  std::vector<double> distance;
  distance.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) distance.push_back((v - centre).squaredNorm());
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
