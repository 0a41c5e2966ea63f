// Triangles that run through each other, against CGAL's exact answer and known cases.
#include "genu/mesh_care/mesh_crossings.h"

#include <gtest/gtest.h>

#include "genu/mesh_care/mesh_intersections.h"
#include "support/blend_meshes.h"

namespace genu {
namespace {

std::size_t count(const Mesh& mesh) { return crossing_triangles(mesh).size(); }

TEST(MeshCrossings, NoneInCleanMeshes) {
  EXPECT_EQ(count({}), 0u);
  EXPECT_EQ(count(test::jittered_torus(15e-3, 5e-3, 1e-3)), 0u);
  EXPECT_EQ(count(test::noisy_sphere(10e-3, 3, 0)), 0u);
  EXPECT_EQ(count(test::jittered_patch(0.02, 1e-3, [](double, double) { return 0.0; })), 0u) << "all in one plane";
}

TEST(MeshCrossings, AsManyAsCgalFinds) {
  if (!built_with_cgal()) GTEST_SKIP() << "built without CGAL";
  const Mesh one = test::noisy_sphere(10e-3, 3, 0.05e-3);
  std::size_t total = 0;
  for (int k = 0; k < 8; ++k) {
    const Pose shift{exp_rotation(Vec3(0.1, 0.2, 0.3) * k), Vec3(7e-3, 1e-3, -2e-3) * (0.3 + 0.2 * k)};
    const Mesh both = test::joined(one, test::moved(test::noisy_sphere(10e-3, 3, 0.05e-3, 8), shift));
    EXPECT_EQ(count(both), count_self_intersections(both).value_or(0)) << k;
    total += count(both);
  }
  EXPECT_GT(total, 500u);
  for (unsigned seed = 1; seed < 6; ++seed) {  // noise so large that neighbours and neighbours' neighbours cross
    const Mesh crumpled = test::noisy_sphere(10e-3, 3, 0.6e-3, seed);
    EXPECT_EQ(count(crumpled), count_self_intersections(crumpled).value_or(0)) << seed;
  }
}

TEST(MeshCrossings, FarFromTheOriginTheSame) {
  const Mesh both = test::joined(test::noisy_sphere(10e-3, 2, 0), test::moved(test::noisy_sphere(10e-3, 2, 0.1e-3),
                                                                              {Mat3::Identity(), Vec3(7e-3, 1e-3, 0)}));
  EXPECT_GT(count(both), 10u);
  EXPECT_EQ(count(test::moved(both, {Mat3::Identity(), Vec3(3, -2, 1)})), count(both));
}

TEST(MeshCrossings, InOnePlane) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}, {1, 1, 0}, {1.2, 1, 0}, {1, 1.2, 0}};
  EXPECT_EQ(count({corners, {{0, 1, 2}, {1, 3, 2}}}), 0u) << "side by side";
  EXPECT_EQ(count({corners, {{0, 1, 2}, {0, 1, 3}}}), 1u) << "folded over a side";
  EXPECT_EQ(count({corners, {{0, 1, 2}, {4, 5, 6}}}), 1u) << "one inside the other";
  EXPECT_EQ(count({corners, {{0, 1, 2}, {0, 2, 1}}}), 1u) << "twice the same";
  EXPECT_EQ(count({corners, {{0, 1, 2}, {0, 0, 3}, {0, 5, 3}}}), 1u) << "those without area are left out";
}

}  // namespace
}  // namespace genu
