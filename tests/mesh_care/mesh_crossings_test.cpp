// Triangles that run through each other, against brute force and known cases. cgal_crossings_test.cpp has CGAL's
// answer.
#include "genu/mesh_care/mesh_crossings.h"

#include <gtest/gtest.h>

#include "support/blend_meshes.h"

namespace genu {
namespace {

/// Are two triangles without a common vertex joined by a segment of one through the other? For meshes in general
/// position: an edge of one must pierce the other.
bool edge_pierces(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const auto side = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a) > 0;
  };
  if (side(t[0], t[1], t[2], p) == side(t[0], t[1], t[2], q)) return false;
  const bool first = side(p, q, t[0], t[1]);
  return first == side(p, q, t[1], t[2]) && first == side(p, q, t[2], t[0]);
}

std::array<Vec3, 3> corners(const Mesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
          mesh.vertices[static_cast<std::size_t>(t[2])]};
}

/// Every triangle of `a` with every triangle of `b`.
std::size_t crossings(const Mesh& a, const Mesh& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      const auto s = corners(a, i), t = corners(b, j);
      bool crossing = false;
      for (std::size_t k = 0; k < 3; ++k)
        crossing = crossing || edge_pierces(s[k], s[(k + 1) % 3], t) || edge_pierces(t[k], t[(k + 1) % 3], s);
      count += crossing ? 1 : 0;
    }
  }
  return count;
}

std::size_t count(const Mesh& mesh) { return crossing_triangles(mesh).size(); }

TEST(MeshCrossings, NoneInCleanMeshes) {
  EXPECT_EQ(count({}), 0u);
  EXPECT_EQ(count(test::jittered_torus(15e-3, 5e-3, 1e-3)), 0u);
  EXPECT_EQ(count(test::noisy_sphere(10e-3, 3, 0)), 0u);
  EXPECT_EQ(count(test::jittered_patch(0.02, 1e-3, [](double, double) { return 0.0; })), 0u) << "all in one plane";
}

TEST(MeshCrossings, TwoSpheresThroughEachOtherAsManyAsBruteForceFinds) {
  const Mesh one = test::noisy_sphere(10e-3, 2, 0.1e-3);
  const Pose shift{exp_rotation(Vec3(0.1, 0.2, 0.3)), Vec3(7e-3, 1e-3, -2e-3)};
  const Mesh two = test::moved(test::noisy_sphere(10e-3, 2, 0.1e-3, 8), shift);
  const std::size_t expected = crossings(one, two);
  EXPECT_GT(expected, 20u);
  EXPECT_EQ(count(test::joined(one, two)), expected);
}

TEST(MeshCrossings, OneVertexPushedThroughTheOtherSide) {
  Mesh sphere = test::noisy_sphere(10e-3, 2, 0);
  EXPECT_EQ(count(sphere), 0u);
  sphere.vertices[0] = -1.3 * sphere.vertices[0];
  EXPECT_GT(count(sphere), 0u);
}

TEST(MeshCrossings, TheWindingDoesNotMatter) {
  const Mesh one = test::noisy_sphere(10e-3, 1, 0.1e-3);
  Mesh both = test::joined(one, test::moved(one, {Mat3::Identity(), Vec3(7e-3, 1e-3, -2e-3)}));
  const std::size_t expected = count(both);
  for (std::size_t i = 0; i < both.triangles.size(); i += 3) std::swap(both.triangles[i][1], both.triangles[i][2]);
  EXPECT_GT(expected, 0u);
  EXPECT_EQ(count(both), expected);
}

TEST(MeshCrossings, ATriangleWithoutAreaIsNotACrossing) {
  const Mesh strip{{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}},
                   {{0, 2, 1}, {0, 3, 2}, {2, 3, 1}}};  // the first lies on the lower sides of the others
  EXPECT_EQ(count(strip), 0u);
}

TEST(MeshCrossings, ThreePagesOnOneEdgeDoNotCross) {
  const Mesh book{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  EXPECT_EQ(count(book), 0u);
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
