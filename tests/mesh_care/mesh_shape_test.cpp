// Numbers of shapes that are known.
#include "genu/mesh_care/mesh_shape.h"

#include <gtest/gtest.h>

#include "support/blend_meshes.h"

namespace genu {
namespace {

TEST(MeshShape, OfASphere) {
  const MeshShape s = shape_of(test::noisy_sphere(10e-3, 4, 0));
  EXPECT_GT(s.fits, 500);
  for (const double c : s.curvature) EXPECT_NEAR(c, 100, 2);
  EXPECT_NEAR(s.sharpest, 100, 2);
  for (const double t : s.thickness) EXPECT_NEAR(t, 20e-3, 0.2e-3);
  EXPECT_LT(s.noise, 1e-6);
}

TEST(MeshShape, OfATorusWithNoise) {
  const MeshShape s = shape_of(test::jittered_torus(15e-3, 5e-3, 0.5e-3, 20e-6));
  EXPECT_NEAR(s.noise, 20e-6, 8e-6);
  EXPECT_NEAR(s.curvature[2], 200, 30);
  EXPECT_NEAR(s.curvature[0], -100, 30);
  EXPECT_NEAR(s.thickness[1], 10e-3, 2e-3);
}

TEST(MeshShape, OfASheetAndOfNothing) {
  const MeshShape s = shape_of(test::jittered_patch(0.02, 1e-3, [](double x, double) { return -20 * x * x; }));
  EXPECT_EQ(s.thickness_rays, 0);
  EXPECT_NEAR(s.curvature[2], 40, 2);
  EXPECT_EQ(shape_of({}).fits, 0);
}

TEST(MeshShape, OrientationOfPieces) {
  const Mesh ball = test::noisy_sphere(10e-3, 2, 0);
  Mesh turned = ball;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  const Mesh flat = test::jittered_patch(0.02, 2e-3, [](double, double) { return 0.0; });
  const Orientation o =
      orientation_of(test::joined(test::joined(ball, test::moved(turned, {Mat3::Identity(), Vec3(0.1, 0, 0)})), flat));
  Mesh mixed = test::joined(ball, test::moved(turned, {Mat3::Identity(), Vec3(0.1, 0, 0)}));
  EXPECT_EQ(turn_odd_pieces(mixed), turned.triangles.size());
  EXPECT_EQ(orientation_of(mixed).inside_out, 0);
  EXPECT_EQ(turn_odd_pieces(turned), 0u) << "all of it: the file's word";
  EXPECT_EQ(o.closed_pieces, 2);
  EXPECT_EQ(o.inside_out, 1);
  EXPECT_NEAR(o.open_area, 0.04 * 0.04, 1e-9);
  EXPECT_NEAR((o.facing - Vec3::UnitZ()).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace genu
