#include "genu/mesh/nearest_point.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace genu
