// Where a surface stands in its body.
#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

TEST(ReadPlacement, OnlyDirectionsCount) {
  const auto axes = [](const std::string& keys) { return ball_with(kBall + keys).placement.R; };
  Mat3 torus_axes;  // columns: x = body y, y = body z, z = body x
  torus_axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_TRUE(axes("x_axis = [0, 1, 0]\nz_axis = [1, 0, 0]\n").isApprox(torus_axes, 1e-15));
  EXPECT_TRUE(axes("z_axis = [1, 0, 0]\n").isApprox(torus_axes, 1e-15)) << "cyclic where x_axis would be parallel";
  // Only directions count, also of huge and tiny vectors, and x_axis is made orthogonal to z_axis.
  const Mat3 R = axes("x_axis = [1e200, 1e200, 5e199]\nz_axis = [0, 0, 1e-200]\n");
  EXPECT_TRUE(R.col(0).isApprox(Vec3(1, 1, 0).normalized(), 1e-15));
  EXPECT_TRUE((R.transpose() * R).isApprox(Mat3::Identity(), 1e-15));
  EXPECT_NEAR(R.determinant(), 1, 1e-15);
}

TEST(ReadPlacement, Errors) {
  expect_surface_refused(kBall + "x_axis = @[0, 0, 2]\n", "x_axis", "[0, 0, 2]", "is parallel to the default z_axis");
  expect_surface_refused(kBall + "z_axis = [1, 1, 0]\nx_axis = @[-2, -2, 0]\n", "x_axis", "[-2, -2, 0]",
                         "is parallel to z_axis");
  expect_surface_refused(kBall + "x_axis = @[0, 0, 0]\n", "x_axis", "[0, 0, 0]", "must not be zero");
  expect_surface_refused(kBall + "z_axis = @[0, 0.0, -0.0]\n", "z_axis", "[0, 0.0, -0.0]", "must not be zero");
  expect_surface_refused(kBall + "z_axis = [0, 0, @inf]\n", "z_axis[3]", "inf", "finite");
  expect_refused("origin = [1, 2, 3]", "origin = @[1, 2]", "surface.ball.origin", "[1, 2]",
                 "three numbers [x, y, z], in mm");
  expect_refused("origin = [1, 2, 3]", "origin = [1, @nan, 3]", "surface.ball.origin[2]", "nan", "finite");
}

}  // namespace
}  // namespace genu::scene_test
