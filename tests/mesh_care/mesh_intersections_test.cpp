// Meshes that run through themselves in a known number of places, or do not.
#include "genu/mesh_care/mesh_intersections.h"

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

class MeshIntersections : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!built_with_cgal()) GTEST_SKIP() << "built without CGAL";
  }
};

TEST(MeshIntersectionsWithoutCgal, AreNotKnown) {
  const Mesh torus = test::jittered_torus(15e-3, 5e-3, 2e-3);
  EXPECT_EQ(count_self_intersections(torus).has_value(), built_with_cgal());
}

TEST_F(MeshIntersections, NoneInACleanMesh) {
  EXPECT_EQ(count_self_intersections(test::jittered_torus(15e-3, 5e-3, 2e-3)), 0u);
  EXPECT_EQ(count_self_intersections(Mesh{}), 0u);
}

TEST_F(MeshIntersections, TwoSpheresThroughEachOtherAsManyAsBruteForceFinds) {
  const Mesh one = test::noisy_sphere(10e-3, 2, 0.1e-3);
  const Pose shift{exp_rotation(Vec3(0.1, 0.2, 0.3)), Vec3(7e-3, 1e-3, -2e-3)};
  const Mesh two = test::moved(test::noisy_sphere(10e-3, 2, 0.1e-3, 8), shift);
  const std::size_t expected = crossings(one, two);
  EXPECT_GT(expected, 20u);
  EXPECT_EQ(count_self_intersections(test::joined(one, two)), expected);
}

TEST_F(MeshIntersections, OneVertexPushedThroughTheOtherSide) {
  Mesh sphere = test::noisy_sphere(10e-3, 2, 0);
  EXPECT_EQ(count_self_intersections(sphere), 0u);
  sphere.vertices[0] = -1.3 * sphere.vertices[0];
  EXPECT_GT(count_self_intersections(sphere).value_or(0), 0u);
}

TEST_F(MeshIntersections, TheWindingDoesNotMatter) {
  const Mesh one = test::noisy_sphere(10e-3, 1, 0.1e-3);
  Mesh both = test::joined(one, test::moved(one, {Mat3::Identity(), Vec3(7e-3, 1e-3, -2e-3)}));
  const auto expected = count_self_intersections(both);
  for (std::size_t i = 0; i < both.triangles.size(); i += 3) std::swap(both.triangles[i][1], both.triangles[i][2]);
  EXPECT_GT(expected.value_or(0), 0u);
  EXPECT_EQ(count_self_intersections(both), expected);
}

TEST_F(MeshIntersections, ATriangleWithoutAreaIsNotACrossing) {
  Mesh strip;
  strip.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}};
  strip.triangles = {{0, 2, 1}, {0, 3, 2}, {2, 3, 1}};  // the first lies on the lower sides of the others
  EXPECT_EQ(count_self_intersections(strip), 0u);
}

TEST_F(MeshIntersections, NotKnownWhereTheTrianglesMakeNoManifold) {
  Mesh book;  // three pages on one edge
  book.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
  book.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  EXPECT_EQ(count_self_intersections(book), std::nullopt);
  Mesh broken = test::noisy_sphere(10e-3, 1, 0);
  broken.triangles[0][0] = 1'000'000;
  EXPECT_EQ(count_self_intersections(broken), std::nullopt);
  broken = test::noisy_sphere(10e-3, 1, 0);
  broken.vertices[0].x() = std::nan("");
  EXPECT_EQ(count_self_intersections(broken), std::nullopt);
}

}  // namespace
}  // namespace genu
