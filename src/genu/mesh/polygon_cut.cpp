#include "genu/mesh/polygon_cut.h"

#include <algorithm>

#include "genu/mesh/tolerances.h"

namespace genu {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 p = b - a, q = c - a;
  return p.x() * q.y() - p.y() * q.x();
}

std::vector<int> corners_of(const Mesh& mesh, const Fan& fan) {
  std::vector<int> corners{mesh.triangles[fan.first][0], mesh.triangles[fan.first][1]};
  for (std::size_t k = 0; k < fan.triangles; ++k) corners.push_back(mesh.triangles[fan.first + k][2]);
  return corners;
}

/// A polygon seen against its mean normal (Newell's: the sum of the fan's area vectors), so that it runs
/// counter-clockwise.
struct FlatPolygon {
  std::vector<Vec2> points;
  double flat = 0;  ///< m^2: twice the area of a triangle that counts as none

  FlatPolygon(const Mesh& mesh, const std::vector<int>& corners) {
    const Vec3& o = mesh.vertices[at(corners[0])];
    Vec3 n = Vec3::Zero();
    for (std::size_t k = 2; k < corners.size(); ++k)
      n += (mesh.vertices[at(corners[k - 1])] - o).cross(mesh.vertices[at(corners[k])] - o);
    flat = kFlatEarShare * n.norm();
    if (!(flat > 0)) return;
    const Vec3 u = n.unitOrthogonal(), v = n.normalized().cross(u);
    for (const int c : corners) points.emplace_back(u.dot(mesh.vertices[at(c)] - o), v.dot(mesh.vertices[at(c)] - o));
  }

  double twice(int a, int b, int c) const { return twice_area(points[at(a)], points[at(b)], points[at(c)]); }

  bool is_fan() const {
    for (int k = 2; k < static_cast<int>(points.size()); ++k)
      if (twice(0, k - 1, k) < -flat) return false;
    return true;
  }

  /// Whether the triangle lies inside what is left of the polygon.
  bool is_ear(int a, int b, int c, const std::vector<int>& left) const {
    if (left.size() == 3) return twice(a, b, c) >= -flat;
    if (!(twice(a, b, c) > flat)) return false;
    return std::none_of(left.begin(), left.end(), [&](int p) {
      const Vec2& x = points[at(p)];
      if (x == points[at(a)] || x == points[at(b)] || x == points[at(c)]) return false;
      return twice(a, b, p) >= 0 && twice(b, c, p) >= 0 && twice(c, a, p) >= 0;
    });
  }
};

/// Empty where the polygon cannot be cut.
Triangles ears(const FlatPolygon& polygon) {
  std::vector<int> left;
  for (int k = 0; k < static_cast<int>(polygon.points.size()); ++k) left.push_back(k);
  Triangles out;
  while (left.size() > 2) {
    const std::size_t n = left.size(), before = out.size();
    for (std::size_t k = 1; k <= n && out.size() == before; ++k) {
      const int a = left[k - 1], b = left[k % n], c = left[(k + 1) % n];
      if (!polygon.is_ear(a, b, c, left)) continue;
      out.push_back({a, b, c});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(k % n));
    }
    if (out.size() == before) return {};
  }
  return out;
}

/// Whether the polygon is now cut without overlap.
bool cut(Mesh& mesh, const Fan& fan) {
  const std::vector<int> corners = corners_of(mesh, fan);
  const FlatPolygon polygon(mesh, corners);
  if (polygon.is_fan()) return true;
  if (corners.size() > kMaxEarCorners) return false;
  const Triangles triangles = ears(polygon);
  if (triangles.empty()) return false;
  for (std::size_t k = 0; k < triangles.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) mesh.triangles[fan.first + k][i] = corners[at(triangles[k][i])];
  return true;
}

}  // namespace

void add_polygon(const std::vector<int>& corners, Mesh& mesh, std::vector<Fan>& fans) {
  if (corners.size() > 3) fans.push_back({mesh.triangles.size(), corners.size() - 2});
  for (std::size_t k = 2; k < corners.size(); ++k) mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

std::size_t cut_concave(Mesh& mesh, const std::vector<Fan>& fans) {
  std::size_t left = 0;
  for (const Fan& fan : fans) left += cut(mesh, fan) ? 0 : 1;
  return left;
}

}  // namespace genu
