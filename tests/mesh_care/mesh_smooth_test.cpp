// Smoothing brings a staircase nearer to the shape it stands for, keeps the volume and its bound, and leaves what is
// smooth nearly alone.
#include "genu/mesh_care/mesh_smooth.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/blend_meshes.h"
#include "support/layers.h"
#include "support/voxels.h"

namespace genu {
namespace {

/// m: root mean square distance of the vertices from a ball of 20 mm about the origin.
double off_the_ball(const Mesh& mesh) {
  double sum = 0;
  for (const Vec3& v : mesh.vertices) sum += std::pow(v.norm() - 20e-3, 2);
  return std::sqrt(sum / static_cast<double>(mesh.vertices.size()));
}

TEST(MeshSmooth, AStaircaseBecomesABall) {
  for (const double voxel : {0.6e-3, 1e-3, 1.5e-3}) {
    Mesh ball = test::voxel_faces([](const Vec3& x) { return x.norm() < 20e-3; }, Vec3::Constant(voxel), 22e-3);
    const double before = off_the_ball(ball);
    const SmoothReport report = smooth_mesh(ball, voxel);
    std::printf("voxels of %.1f mm: %.3f mm off the ball before, %.3f after; moved by %.3f mm rms, %d held\n",
                1e3 * voxel, 1e3 * before, 1e3 * off_the_ball(ball), 1e3 * report.rms, report.held);
    EXPECT_LT(off_the_ball(ball), 0.35 * before);
    EXPECT_LE(report.largest, voxel * (1 + 1e-12));
    EXPECT_NEAR(report.volume_after, report.volume_before, 2e-3 * report.volume_before);
  }
}

TEST(MeshSmooth, KeepsTheBound) {
  Mesh ball = test::voxel_faces([](const Vec3& x) { return x.norm() < 20e-3; }, Vec3::Constant(1e-3), 22e-3);
  const Mesh before = ball;
  const SmoothReport report = smooth_mesh(ball, 0.1e-3);
  EXPECT_GT(report.held, 0);
  double largest = 0;
  for (std::size_t v = 0; v < ball.vertices.size(); ++v)
    largest = std::max(largest, (ball.vertices[v] - before.vertices[v]).norm());
  EXPECT_NEAR(largest, 0.1e-3, 1e-12);
  EXPECT_EQ(ball.triangles, before.triangles);
}

TEST(MeshSmooth, ASmoothShapeStays) {
  Mesh ball = test::ball(20e-3, 1e-3);
  const SmoothReport report = smooth_mesh(ball, 1e-3);
  EXPECT_LT(off_the_ball(ball), 0.02e-3);
  EXPECT_NEAR(report.volume_after, report.volume_before, 1e-3 * report.volume_before);
  Mesh bowl = test::jittered_patch(25e-3, 1e-3, [](double x, double y) { return 12.5 * (x * x + y * y); });
  smooth_mesh(bowl, 1e-3);
  double worst = 0;
  for (const Vec3& v : bowl.vertices)
    if (v.head<2>().cwiseAbs().maxCoeff() < 18e-3)
      worst = std::max(worst, std::abs(v.z() - 12.5 * v.head<2>().squaredNorm()));
  EXPECT_LT(worst, 0.03e-3);
}

}  // namespace
}  // namespace genu
