// The nearest point in place and direction is the one that trying all of them finds.
#include "genu/atlas/point_tree.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "genu/atlas/tolerances.h"

namespace genu {
namespace {

std::vector<FacingPoint> random_points(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> side(-0.04, 0.04);
  std::vector<FacingPoint> out(count);
  for (FacingPoint& p : out) {
    for (double& x : p.at) x = side(random);
    for (double& x : p.normal) x = side(random);
    p.normal.normalize();
  }
  return out;
}

TEST(PointTree, FindsWhatTryingAllFinds) {
  std::mt19937 random(7);
  std::vector<FacingPoint> points = random_points(700, random);
  for (int k = 0; k < 50; ++k) points.push_back(points[at(k)]);  // twice: the first counts
  const PointTree tree(points);
  for (const FacingPoint& asked : random_points(500, random)) {
    double least = std::numeric_limits<double>::infinity();
    int nearest = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double d = (points[i].at - asked.at).squaredNorm() +
                       kTurnLength * kTurnLength * (points[i].normal - asked.normal).squaredNorm();
      if (d < least) {
        least = d;
        nearest = static_cast<int>(i);
      }
    }
    EXPECT_EQ(tree.nearest(asked), nearest);
  }
  EXPECT_EQ(tree.nearest(points[3]), 3);
}

TEST(PointTree, OfNothingAndOfOne) {
  EXPECT_EQ(PointTree({}).nearest({}), -1);
  EXPECT_EQ(PointTree({{Vec3(1, 2, 3), Vec3::UnitX()}}).nearest({}), 0);
}

TEST(FacingVertices, AreVerticesWithMeanNormals) {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(5, 5, 5)};
  mesh.triangles = {{0, 1, 2}};
  const std::vector<FacingPoint> points = facing_vertices(mesh, 10);
  ASSERT_EQ(points.size(), 3u);  // not that of no triangle
  for (const FacingPoint& p : points) EXPECT_EQ(p.normal, Vec3::UnitZ());
  EXPECT_EQ(facing_vertices(mesh, 2).size(), 2u);
}

}  // namespace
}  // namespace genu
