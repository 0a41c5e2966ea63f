// Staircases are found with their height and direction; round, flat and machined shapes have none.
#include "genu/mesh/stair_steps.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "genu/core/pose.h"
#include "support/blend_meshes.h"
#include "support/layers.h"
#include "support/random_points.h"
#include "support/shells.h"
#include "support/voxels.h"

namespace genu {
namespace {

bool in_ball(const Vec3& x) { return x.norm() < 20e-3; }

TEST(StairSteps, OfSlices) {
  for (const double slice : {0.5e-3, 1e-3, 2.5e-3}) {
    const Mesh ball = test::voxel_faces(in_ball, {0.5e-3, 0.5e-3, slice}, 22e-3);
    const auto found = stair_steps(ball);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->height, slice, 1e-9);
    if (slice > 0.5e-3) {
      EXPECT_NEAR(std::abs(found->direction.z()), 1, 1e-12);
    }
    EXPECT_GT(found->levels, 10);
    // What is known of the ball: its surface lies half-way through the voxels.
    double sum = 0;
    for (const Vec3& v : ball.vertices) sum += std::pow(v.norm() - 20e-3, 2);
    const double off = std::sqrt(sum / static_cast<double>(ball.vertices.size()));
    std::printf("slices of %.1f mm: %.3f mm rms off the ball, %.3f told\n", 1e3 * slice, 1e3 * off, 1e3 * found->rms);
    EXPECT_GT(found->rms, 0.7 * off);
    EXPECT_LT(found->rms, 2 * off);
  }
}

TEST(StairSteps, InAnyDirection) {
  Mesh ball = test::voxel_faces(in_ball, Vec3::Constant(1e-3), 22e-3);
  const Pose X{exp_rotation({0.7, -0.4, 1.1}), {0.1, 0.05, -0.2}};
  for (Vec3& v : ball.vertices) v = X * v;
  const auto found = stair_steps(ball);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->height, 1e-3, 1e-6);
  EXPECT_NEAR(found->rms, 0.5e-3, 1e-6);
  EXPECT_NEAR((X.R.transpose() * found->direction).cwiseAbs().maxCoeff(), 1, 1e-4);
}

TEST(StairSteps, OtherShapesHaveNone) {
  EXPECT_FALSE(stair_steps({}));
  EXPECT_FALSE(stair_steps(test::sheet(20e-3, 40)));
  EXPECT_FALSE(stair_steps(test::box({-10e-3, -10e-3, -5e-3}, {10e-3, 10e-3, 5e-3}, 20)));
  EXPECT_FALSE(stair_steps(test::ball(20e-3, 1e-3)));
  EXPECT_FALSE(stair_steps(test::jittered_torus(15e-3, 5e-3, 1e-3)));
  EXPECT_FALSE(stair_steps(test::jittered_patch(20e-3, 1e-3, [](double x, double y) { return 2 * (x * x + y * y); })));
  // A plane that is rough by less than its facets are large: heights of all sizes.
  for (const double rough : {1e-6, 5e-6, 20e-6, 100e-6}) {
    test::RandomPoints random(3);
    Mesh plane = test::sheet(20e-3, 60);
    for (Vec3& v : plane.vertices) v.z() += random.uniform(-rough, rough);
    EXPECT_FALSE(stair_steps(plane)) << rough;
    for (Vec3& v : plane.vertices) v.z() = 1e-5 * std::round(v.z() / 1e-5);  // written with two decimals
    EXPECT_FALSE(stair_steps(plane)) << rough;
  }
}

}  // namespace
}  // namespace genu
