#include "genu/mesh/display_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "genu/surface/tessellate.h"

namespace genu {
namespace {

TEST(DisplayMesh, LeavesAMeshThatIsSmallEnough) {
  const Mesh ball = geodesic_mesh(Vec3(0.02, 0.02, 0.02), 0.002);
  const Mesh shown = display_mesh(ball, ball.triangles.size());
  EXPECT_EQ(shown.vertices, ball.vertices);
  EXPECT_EQ(shown.triangles, ball.triangles);
  EXPECT_TRUE(display_mesh(Mesh{}, 10).empty());
}

TEST(DisplayMesh, ThinsOutALargeOneAndStaysOnIt) {
  constexpr double kRadius = 0.02;
  constexpr std::size_t kMost = 4000;
  const Mesh ball = geodesic_mesh(Vec3(kRadius, kRadius, kRadius), 0.0003);
  ASSERT_GT(ball.triangles.size(), 10 * kMost);
  const Mesh shown = display_mesh(ball, kMost);
  EXPECT_LE(shown.triangles.size(), kMost);
  EXPECT_GT(shown.triangles.size(), kMost / 3);
  for (const Vec3& v : shown.vertices)
    EXPECT_NE(std::find(ball.vertices.begin(), ball.vertices.end(), v), ball.vertices.end());
  // The volume it closes is the ball's, but for the chords: no hole, no triangle turned round.
  double volume = 0;
  for (const auto& t : shown.triangles) {
    const Vec3 &a = shown.vertices[at(t[0])], &b = shown.vertices[at(t[1])], &c = shown.vertices[at(t[2])];
    volume += a.dot(b.cross(c)) / 6;
  }
  EXPECT_NEAR(volume, 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3), 0.02 * volume);
}

TEST(DisplayMesh, ComesToAnEndWhereAllTrianglesAreFlat) {
  Mesh line;
  for (int i = 0; i < 2000; ++i) line.vertices.emplace_back(i, 0, 0);
  for (int i = 0; i + 2 < 2000; ++i) line.triangles.push_back({i, i + 1, i + 2});
  EXPECT_LE(display_mesh(line, 1000).triangles.size(), 1000u);
}

}  // namespace
}  // namespace genu
