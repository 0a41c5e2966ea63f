// How far a point keeps its side of an open sheet, and lower bounds of its distance to the edge.
#include "genu/contact/sheet_side.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_topology.h"
#include "support/random_points.h"
#include "support/sheet_mesh.h"

namespace genu {
namespace {

/// A square sheet of half side 10 mm, outward +z, bent to the radius `bend` (m) about the axis y; flat for 0.
Mesh sheet(int cells, double bend) {
  return test::bent_sheet(cells, [bend](double u, double v) {
    if (bend == 0) return Vec3(0.01 * u, 0.01 * v, 0);
    const double angle = 0.01 * u / bend;
    return Vec3(bend * std::sin(angle), 0.01 * v, bend * (std::cos(angle) - 1));
  });
}

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const double share = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + share * (b - a) - x).norm();
}

TEST(EdgeDistance, IsALowerBoundAndNotFarBelow) {
  for (const auto& [cells, bend] : {std::pair{1, 0.0}, {7, 0.0}, {40, 0.0}, {30, 0.008}}) {
    const Mesh mesh = sheet(cells, bend);
    const std::vector<MeshEdge> edges = mesh_edges(mesh);
    const FeatureNormals normals(mesh);
    const EdgeDistance bound(mesh, normals);
    std::mt19937 random(3);
    double widest = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3 x = test::random_vector(random, 0.03);
      double exact = 1;
      for (const MeshEdge& e : edges)
        if (e.count == 1)
          exact = std::min(exact, distance_to_segment(x, mesh.vertices[at(e.v[0])], mesh.vertices[at(e.v[1])]));
      EXPECT_LE(bound(x), exact + 1e-15);
      widest = std::max(widest, exact - bound(x));
    }
    EXPECT_LT(widest, 0.03 * 0.06 + 1.5 * 0.02 / cells) << cells;
  }
}

TEST(SheetSide, ThereIsNoneOfAClosedMesh) {
  Mesh tetrahedron;
  tetrahedron.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  EXPECT_FALSE(SheetSide::of(tetrahedron, FeatureNormals(tetrahedron)));
}

TEST(SheetSide, OverItsMiddleAPointKeepsItsSideAsFarAsItIsAway) {
  const Mesh mesh = sheet(20, 0);
  const FeatureNormals normals(mesh);
  const auto sides = SheetSide::of(mesh, normals);
  ASSERT_TRUE(sides);
  double side = 1;
  for (const double height : {1e-4, 1e-3, 2.5e-3})
    EXPECT_GE(sides->at({0, 0, height}, {0, 0, height}, Vec3::UnitZ(), false, side), height);
  // Near the edge it may go round it: half of what the edge is farther away than the sheet, or what winding allows.
  const double beside = sides->at({0.009, 0, 1e-3}, {0, 0, 1e-3}, Vec3::UnitZ(), false, side);
  EXPECT_LT(beside, 1e-3);
  EXPECT_GT(beside, 0.2e-3);
  EXPECT_EQ(side, 1);
}

TEST(SheetSide, BehindTheEdgeAPointIsInside) {
  const Mesh mesh = sheet(20, 0.008);
  const FeatureNormals normals(mesh);
  const auto sides = SheetSide::of(mesh, normals);
  ASSERT_TRUE(sides);
  const auto side_at = [&](const Vec3& x, const Vec3& edge, const Vec3& normal) {
    double side = 1;
    sides->at(x, x - edge, normal, true, side);
    return side;
  };
  const Vec3 edge(0.008 * std::sin(1.25), 0, 0.008 * (std::cos(1.25) - 1)), normal(std::sin(1.25), 0, std::cos(1.25));
  EXPECT_EQ(side_at({0.002, 0, -0.0075}, edge, normal), -1);
  EXPECT_EQ(side_at(edge + 0.002 * normal + Vec3(0, 0, -0.001), edge, normal), 1);
}

}  // namespace
}  // namespace genu
