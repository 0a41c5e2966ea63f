// Triangles of polygons: a fan where that is right, ears where it is not.
#include "genu/mesh/polygon_cut.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

namespace genu {
namespace {

using std::numbers::pi;

/// The polygon in a plane that is not one of the axes'.
Mesh polygon(const std::vector<Vec2>& points, std::vector<Fan>& fans) {
  const Vec3 u = Vec3(1, 2, 2) / 3, v = Vec3(2, 1, -2) / 3;
  Mesh mesh;
  std::vector<int> corners(points.size());
  std::iota(corners.begin(), corners.end(), 0);
  for (const Vec2& p : points) mesh.vertices.push_back(Vec3(0.1, -0.2, 0.3) + p.x() * u + p.y() * v);
  add_polygon(corners, mesh, fans);
  return mesh;
}

struct Areas {
  double sum = 0, smallest = 0;  ///< signed, against the polygon's normal
};

Areas areas(const Mesh& mesh) {
  const Vec3 n = Vec3(1, 2, 2).cross(Vec3(2, 1, -2)) / 9;
  Areas out{0, 1e9};
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[at(t[0])];
    const double area = 0.5 * n.dot((mesh.vertices[at(t[1])] - a).cross(mesh.vertices[at(t[2])] - a));
    out.sum += area;
    out.smallest = std::min(out.smallest, area);
  }
  return out;
}

double area(const std::vector<Vec2>& p) {
  double twice = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Vec2 &a = p[k], &b = p[(k + 1) % p.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

std::vector<Vec2> rotated(std::vector<Vec2> points, std::size_t by) {
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(by), points.end());
  return points;
}

const std::vector<Vec2> kArrow{{0, 0}, {2, -1}, {0.5, 0}, {2, 1}};                      // reflex: its third corner
const std::vector<Vec2> kL{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};             // of right angles
const std::vector<Vec2> kComb{{0, 0}, {5, 0}, {5, 3}, {4, 1}, {3, 3}, {2, 1}, {1, 3}};  // three reflex corners
const std::vector<Vec2> kStraight{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}};    // and a straight one

TEST(PolygonCut, ConcavePolygonsAreCutWithoutOverlapFromEveryFirstCorner) {
  for (const auto& shape : {kArrow, kL, kComb, kStraight})
    for (std::size_t by = 0; by < shape.size(); ++by) {
      std::vector<Fan> fans;
      Mesh mesh = polygon(rotated(shape, by), fans);
      const std::size_t triangles = mesh.triangles.size();
      EXPECT_EQ(cut_concave(mesh, fans), 0u);
      EXPECT_EQ(mesh.triangles.size(), triangles);
      EXPECT_NEAR(areas(mesh).sum, area(shape), 1e-12);
      EXPECT_GT(areas(mesh).smallest, -1e-12) << "corners " << shape.size() << ", first " << by;
    }
}

TEST(PolygonCut, AQuadIsCutFromItsReflexCorner) {
  std::vector<Fan> fans;
  Mesh mesh = polygon(kArrow, fans);
  EXPECT_EQ(cut_concave(mesh, fans), 0u);
  for (const auto& t : mesh.triangles) EXPECT_TRUE(t[0] == 2 || t[1] == 2 || t[2] == 2);
}

TEST(PolygonCut, ConvexPolygonsStayFans) {
  for (const int n : {3, 4, 5, 8, 1200}) {
    std::vector<Vec2> points;
    for (int k = 0; k < n; ++k) points.emplace_back(3 * std::cos(2 * pi * k / n), std::sin(2 * pi * k / n));
    std::vector<Fan> fans;
    Mesh mesh = polygon(points, fans);
    const Mesh fan = mesh;
    EXPECT_EQ(fans.size(), n > 3 ? 1u : 0u);
    EXPECT_EQ(cut_concave(mesh, fans), 0u);
    EXPECT_EQ(mesh.triangles, fan.triangles);
  }
}

TEST(PolygonCut, WarpedAndFlatQuadsStayFans) {
  std::vector<Fan> fans;
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0.2}, {1, 1, 0}, {0, 1, 0.2}, {0, 0, 0}, {0, 0, 0}};
  add_polygon({0, 1, 2, 3}, mesh, fans);
  add_polygon({0, 4, 5, 0}, mesh, fans);  // of no extent
  const Mesh fan = mesh;
  EXPECT_EQ(cut_concave(mesh, fans), 0u);
  EXPECT_EQ(mesh.triangles, fan.triangles);
}

TEST(PolygonCut, WhatCrossesItselfOrIsTooLargeStaysAFanAndIsCounted) {
  std::vector<Fan> fans;
  Mesh bow = polygon({{0, 0}, {2, 2}, {2, 0}, {0, 1}}, fans);
  const Mesh fan = bow;
  EXPECT_EQ(cut_concave(bow, fans), 1u);
  EXPECT_EQ(bow.triangles, fan.triangles);
  std::vector<Vec2> star;
  for (int k = 0; k < 2000; ++k) {
    const double r = k % 2 == 0 ? 1 : 0.5;
    star.emplace_back(r * std::cos(pi * k / 1000), r * std::sin(pi * k / 1000));
  }
  fans.clear();
  Mesh large = polygon(star, fans);
  EXPECT_EQ(cut_concave(large, fans), 1u);
}

}  // namespace
}  // namespace genu
