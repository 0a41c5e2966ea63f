#include "genu/mesh/mesh_weld.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "genu/mesh/coordinate_step.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/tolerances.h"
#include "genu/mesh/two_sided.h"

namespace genu {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0;
    for (const std::int64_t k : c) h = (h ^ static_cast<std::uint64_t>(k)) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
    return static_cast<std::size_t>(h);
  }
};

// Equal vertices become the first of them. Sorting indices by position keeps this exact and deterministic.
std::vector<int> join_equal(const std::vector<Vec3>& vertices) {
  const auto less = [&](int a, int b) {
    const Vec3 &p = vertices[at(a)], &q = vertices[at(b)];
    if (p.x() != q.x()) return p.x() < q.x();
    if (p.y() != q.y()) return p.y() < q.y();
    if (p.z() != q.z()) return p.z() < q.z();
    return a < b;
  };
  std::vector<int> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), less);
  std::vector<int> first(vertices.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && vertices[at(order[k])] == vertices[at(order[k - 1])];
    first[at(order[k])] = same ? first[at(order[k - 1])] : order[k];
  }
  return first;
}

// Among the vertices that stand for themselves, those near an earlier one become it. The cells are two tolerances
// wide, so that whatever is within one tolerance lies in one of the eight cells round the nearest corner.
void join_near(const std::vector<Vec3>& vertices, double tolerance, std::vector<int>& first) {
  if (!(tolerance > 0)) return;
  const double width = 2 * tolerance;
  std::unordered_map<Cell, std::vector<int>, CellHash> cells;
  cells.reserve(vertices.size());
  const auto cell_of = [&](const Vec3& x) {
    return Cell{static_cast<std::int64_t>(std::floor(x[0] / width)),
                static_cast<std::int64_t>(std::floor(x[1] / width)),
                static_cast<std::int64_t>(std::floor(x[2] / width))};
  };
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (first[v] != static_cast<int>(v)) {
      first[v] = first[at(first[v])];  // its representative came earlier, and may have been joined meanwhile
      continue;
    }
    const Vec3& x = vertices[v];
    const Cell corner = cell_of(x - Vec3::Constant(tolerance));
    int nearest = -1;
    for (int k = 0; k < 8; ++k) {
      const auto found = cells.find({corner[0] + (k & 1), corner[1] + (k >> 1 & 1), corner[2] + (k >> 2)});
      if (found == cells.end()) continue;
      for (const int w : found->second) {
        if ((nearest < 0 || w < nearest) && (vertices[at(w)] - x).norm() <= tolerance) nearest = w;
      }
    }
    if (nearest >= 0) {
      first[v] = nearest;
    } else {
      cells[cell_of(x)].push_back(static_cast<int>(v));
    }
  }
}

/// How many vertices stand for themselves.
std::size_t own_count(const std::vector<int>& first) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < first.size(); ++v) count += first[v] == static_cast<int>(v) ? 1 : 0;
  return count;
}

std::size_t drop_degenerate(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

/// Whether the corners of t, from the smallest one on, ascend.
bool ascends(const std::array<int, 3>& t) { return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2; }

/// Keeps the first of the triangles that have the same corners. both_ways: for those that stay, whether another one ran
/// the other way.
std::size_t drop_duplicate(Mesh& mesh, std::vector<bool>& both_ways) {
  std::vector<std::array<int, 4>> keys(mesh.triangles.size());  // sorted corners, then the triangle
  for (std::size_t t = 0; t < keys.size(); ++t) {
    auto c = mesh.triangles[t];
    std::sort(c.begin(), c.end());
    keys[t] = {c[0], c[1], c[2], static_cast<int>(t)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> repeats(keys.size(), false), turned(keys.size(), false);
  for (std::size_t k = 1, first = 0; k < keys.size(); ++k) {
    const bool same = std::equal(keys[k].begin(), keys[k].begin() + 3, keys[first].begin());
    if (!same) first = k;
    const std::size_t t = at(keys[k][3]), kept = at(keys[first][3]);
    repeats[t] = same;
    if (ascends(mesh.triangles[t]) != ascends(mesh.triangles[kept])) turned[kept] = true;
  }
  for (std::size_t t = 0; t < keys.size(); ++t)
    if (!repeats[t]) both_ways.push_back(turned[t]);
  std::size_t index = 0;
  return std::erase_if(mesh.triangles, [&](const auto&) { return repeats[index++]; });
}

}  // namespace

void drop_unused_vertices(Mesh& mesh) {
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const auto& t : mesh.triangles) {
    for (const int v : t) number[at(v)] = 0;
  }
  int used = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = used;
    mesh.vertices[at(used++)] = mesh.vertices[v];
  }
  mesh.vertices.resize(at(used));
  for (auto& t : mesh.triangles) {
    for (int& v : t) v = number[at(v)];
  }
}

double weld_tolerance(const Mesh& mesh) {
  const CoordinateStep written = coordinate_step(mesh);
  const BoundingBox box = bounding_box(mesh);
  const double largest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
  const double rounding =
      written.single > 0 ? kWeldFloatUlps * largest : std::min(2 * written.decimal, kWeldFloatUlps * largest);
  return std::max(kWeldBoxShare * box.diagonal(), rounding);
}

WeldReport weld(Mesh& mesh, double tolerance) {
  std::vector<int> first = join_equal(mesh.vertices);
  const std::size_t equal = own_count(first);
  join_near(mesh.vertices, tolerance, first);
  for (auto& t : mesh.triangles) {
    for (int& v : t) v = first[at(v)];
  }
  WeldReport report;
  report.joined = first.size() - equal;
  report.joined_near = equal - own_count(first);
  report.degenerate = drop_degenerate(mesh);
  std::vector<bool> both_ways;
  report.duplicate = drop_duplicate(mesh, both_ways);
  report.both_ways = static_cast<std::size_t>(std::count(both_ways.begin(), both_ways.end(), true));
  if (report.both_ways > 0) choose_sides(mesh, both_ways);
  drop_unused_vertices(mesh);
  return report;
}

}  // namespace genu
