#include "genu/mesh_care/piece_meetings.h"

#include <gtest/gtest.h>

#include "genu/mesh/mesh_join.h"

namespace genu {
namespace {

constexpr double kEdge = 1e-3;

/// 10 x 10 squares of 1 mm in a plane through `corner`.
Mesh squares(const Vec3& corner, const Vec3& along, const Vec3& across) {
  Mesh mesh;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) mesh.vertices.emplace_back(corner + kEdge * (i * along + j * across));
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      const int k = 11 * i + j;
      mesh.triangles.push_back({k, k + 11, k + 1});
      mesh.triangles.push_back({k + 11, k + 12, k + 1});
    }
  return mesh;
}

std::vector<PieceMeeting> meetings(const std::vector<Mesh>& pieces) {
  const JoinedMesh joined = join_pieces(pieces, 1e-8);
  return piece_meetings(joined.mesh, joined.ends);
}

const Vec3 kX = Vec3::UnitX(), kY = Vec3::UnitY(), kZ = Vec3::UnitZ();

TEST(PieceMeetings, NothingOfPiecesApartOrJoined) {
  const Mesh a = squares(Vec3::Zero(), kX, kY);
  EXPECT_TRUE(meetings({a, squares(Vec3(20e-3, 0, 0), kX, kY)}).empty());
  EXPECT_TRUE(meetings({a, squares(Vec3(10.6e-3, 0, 0), kX, kY)}).empty());
  EXPECT_TRUE(meetings({a, squares(Vec3(10e-3, 0, 0), kX, kY)}).empty());
}

TEST(PieceMeetings, APieceThatRunsThroughAnother) {
  const auto found = meetings({squares(Vec3(0, 0, -0.5e-3), kX, kY), squares(Vec3(4.3e-3, 0.2e-3, -4.2e-3), kY, kZ)});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].a, 0u);
  EXPECT_EQ(found[0].b, 1u);
  EXPECT_GE(found[0].crossings, 10u);
  EXPECT_NEAR(found[0].place.x(), 4.3e-3, kEdge);
}

TEST(PieceMeetings, ASlitAndItsWidth) {
  const auto found = meetings(
      {squares(Vec3::Zero(), kX, kY), squares(Vec3(30e-3, 0, 0), kX, kY), squares(Vec3(10.3e-3, 0.4e-3, 0), kX, kY)});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].a, 0u);
  EXPECT_EQ(found[0].b, 2u);
  EXPECT_EQ(found[0].crossings, 0u);
  EXPECT_NEAR(found[0].gap, 0.3e-3, 1e-9);
}

}  // namespace
}  // namespace genu
