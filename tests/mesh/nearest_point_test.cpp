#include "genu/mesh/nearest_point.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/random_points.h"

namespace genu {
namespace {

TEST(NearestPoint, IsOnACornerAnEdgeOrInside) {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(nearest_on_mesh(mesh, Vec3(-1, -1, 1)), Vec3(0, 0, 0));
  EXPECT_EQ(nearest_on_mesh(mesh, Vec3(2, -1, 0)), Vec3(1, 0, 0));
  EXPECT_LT((nearest_on_mesh(mesh, Vec3(1, 1, 0)) - Vec3(0.5, 0.5, 0)).norm(), 1e-15);
  EXPECT_LT((nearest_on_mesh(mesh, Vec3(0.2, 0.3, 5)) - Vec3(0.2, 0.3, 0)).norm(), 1e-15);
  EXPECT_EQ(nearest_on_mesh({}, Vec3(1, 2, 3)), Vec3(1, 2, 3));
}

/// p of a convex set is nearest to x if and only if (x - p) . (y - p) <= 0 for all y of the set, here its corners.
TEST(NearestPoint, NoCornerLiesFurtherTowardThePlace) {
  test::RandomPoints random(5);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 a = random.in_ball(1), b = random.in_ball(1), x = random.in_ball(3);
    const Vec3 c = k % 10 == 0 ? Vec3(a + 0.3 * (b - a)) : random.in_ball(1);
    const Vec3 p = nearest_on_triangle(x, a, b, c);
    EXPECT_TRUE(p.allFinite()) << k;
    if (k % 10 == 0) continue;  // without area
    for (const Vec3& corner : {a, b, c}) EXPECT_LT((x - p).dot(corner - p), 1e-12) << k;
    EXPECT_LT(std::abs((b - a).cross(c - a).normalized().dot(p - a)), 1e-12) << "in the plane of triangle " << k;
  }
}

TEST(NearestPoint, OfAMeshIsThatOfItsNearestTriangle) {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 2), Vec3(1, 0, 2), Vec3(0, 1, 2)};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  std::size_t triangle = 7;
  EXPECT_LT((nearest_on_mesh(mesh, Vec3(0.2, 0.2, 1.5), &triangle) - Vec3(0.2, 0.2, 2)).norm(), 1e-15);
  EXPECT_EQ(triangle, 1u);
}

}  // namespace
}  // namespace genu
