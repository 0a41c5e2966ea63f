#include "genu/surface/tessellate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>

#include "genu/surface/tolerances.h"

namespace genu {
namespace {

constexpr double kEquilateralArea = 0.4330127018922193;  // of an equilateral triangle, per squared edge

}  // namespace

double graded_edge(double edge, double radius) { return std::min(edge, 0.5 * radius); }

double affordable_edge(double edge, double area) {
  return std::max(edge, std::sqrt(area / (kEquilateralArea * kMaxTriangles)));
}

int grid_count(double length, double edge) {
  const double count = std::clamp(std::round(length / edge), 3.0, kMaxTriangles);
  return static_cast<int>(count);
}

Mesh grid_mesh(const GridAxis& s, const GridAxis& t, const std::function<Vec3(double, double)>& position) {
  const int columns = s.closed ? s.count : s.count + 1, rows = t.closed ? t.count : t.count + 1;
  Mesh mesh;
  mesh.vertices.reserve(at(columns) * at(rows));
  mesh.triangles.reserve(2 * at(s.count) * at(t.count));
  for (int j = 0; j < rows; ++j) {
    const double shift = s.closed && j % 2 == 1 ? 0.5 : 0.0;
    for (int i = 0; i < columns; ++i) {
      mesh.vertices.push_back(position((i + shift) / s.count, static_cast<double>(j) / t.count));
    }
  }
  const auto index = [&](int i, int j) { return (j % rows) * columns + i % columns; };
  for (int j = 0; j < t.count; ++j) {
    for (int i = 0; i < s.count; ++i) {
      const int a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      // The diagonal that runs with the shift of the rows; without a shift, alternating like a Union Jack.
      const bool rising = s.closed ? j % 2 == 1 : (i + j) % 2 == 1;
      if (rising) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

Mesh geodesic_mesh(const Vec3& radii, double edge) {
  constexpr double g = std::numbers::phi;
  const std::array<Vec3, 12> corners{Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0),
                                     Vec3(0, -1, g), Vec3(0, 1, g), Vec3(0, -1, -g), Vec3(0, 1, -g),
                                     Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)};
  constexpr int faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  constexpr double kArc = 1.1071487177940904;  // between neighbouring corners, seen from the centre
  const double shortest = radii.minCoeff();
  constexpr double kMostDivisions = 100;
  static_assert(20 * kMostDivisions * kMostDivisions <= kMaxTriangles);
  const double divisions = std::min(kMostDivisions, kArc * shortest / graded_edge(edge, shortest));
  const int n = std::max(2, static_cast<int>(std::lround(divisions)));
  Mesh mesh;
  // A vertex is known by its weights on the corners, which neighbouring faces share along an edge.
  std::map<std::array<int, 6>, int> known;
  const auto vertex = [&](const int(&face)[3], int i, int j) {
    std::array<std::pair<int, int>, 3> weights{std::pair{face[0], n - i - j}, {face[1], i}, {face[2], j}};
    std::sort(weights.begin(), weights.end());
    std::array<int, 6> key{};
    std::size_t used = 0;
    Vec3 p = Vec3::Zero();
    for (const auto& [corner, weight] : weights) {
      if (weight == 0) continue;
      key[used++] = corner;
      key[used++] = weight;
      p += weight * corners[at(corner)];
    }
    const auto [entry, fresh] = known.try_emplace(key, static_cast<int>(mesh.vertices.size()));
    if (fresh) mesh.vertices.push_back(radii.cwiseProduct(p.normalized()));
    return entry->second;
  };
  for (const auto& face : faces) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const int a = vertex(face, i, j), b = vertex(face, i + 1, j), c = vertex(face, i, j + 1);
        mesh.triangles.push_back({a, b, c});
        if (i + j + 1 < n) mesh.triangles.push_back({b, vertex(face, i + 1, j + 1), c});
      }
    }
  }
  return mesh;
}

void keep_near(Mesh& mesh, const Vec3& centre, double distance) {
  std::vector<bool> near(mesh.vertices.size());
  for (std::size_t i = 0; i < near.size(); ++i) near[i] = (mesh.vertices[i] - centre).norm() <= distance;
  std::erase_if(mesh.triangles, [&](const auto& t) { return !near[at(t[0])] && !near[at(t[1])] && !near[at(t[2])]; });
  std::vector<int> renumbered(mesh.vertices.size(), -1);
  std::vector<Vec3> kept;
  for (auto& t : mesh.triangles) {
    for (int& v : t) {
      if (renumbered[at(v)] < 0) {
        renumbered[at(v)] = static_cast<int>(kept.size());
        kept.push_back(mesh.vertices[at(v)]);
      }
      v = renumbered[at(v)];
    }
  }
  mesh.vertices = std::move(kept);
}

double smallest_angle(const Mesh& mesh) {
  double smallest = std::numbers::pi / 3;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.vertices[at(t[k])];
      const Vec3 a = mesh.vertices[at(t[(k + 1) % 3])] - p, b = mesh.vertices[at(t[(k + 2) % 3])] - p;
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  return smallest;
}

}  // namespace genu
