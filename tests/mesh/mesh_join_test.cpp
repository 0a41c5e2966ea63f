#include "genu/mesh/mesh_join.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

/// A sheet of 2 x 2 triangles from `x` on, 1 wide.
Mesh sheet(double x, double y = 0) {
  Mesh mesh;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 3; ++j) mesh.vertices.emplace_back(x + i, y + j, 0);
  for (int j = 0; j < 2; ++j) {
    mesh.triangles.push_back({j, j + 3, j + 1});
    mesh.triangles.push_back({j + 3, j + 4, j + 1});
  }
  return mesh;
}

TEST(MeshJoin, PiecesApartStayApart) {
  const JoinedMesh joined = join_pieces({sheet(0), sheet(5)}, 1e-6);
  EXPECT_EQ(joined.mesh.vertices.size(), 12u);
  EXPECT_EQ(joined.mesh.triangles.size(), 8u);
  EXPECT_EQ(joined.ends, (std::vector<std::size_t>{4, 8}));
  EXPECT_TRUE(joined.borders.empty());
  EXPECT_EQ(joined.repeated, 0u);
}

TEST(MeshJoin, ASharedBorderIsWelded) {
  Mesh beside = sheet(1);
  for (Vec3& v : beside.vertices) v += Vec3(4e-7, 0, 0);  // as another file's rounding leaves it
  const JoinedMesh joined = join_pieces({sheet(0), beside, sheet(0, 10)}, 1e-6);
  EXPECT_EQ(joined.mesh.vertices.size(), 9u + 6u);
  EXPECT_EQ(joined.mesh.vertices[3], Vec3(1, 0, 0));  // the earlier piece's
  ASSERT_EQ(joined.borders.size(), 1u);
  EXPECT_EQ(joined.borders[0].a, 0u);
  EXPECT_EQ(joined.borders[0].b, 1u);
  EXPECT_EQ(joined.borders[0].vertices, 3u);
  EXPECT_EQ(join_pieces({sheet(0), beside}, 1e-7).mesh.vertices.size(), 12u);
}

TEST(MeshJoin, WhatStandsInTwoPiecesIsThereOnce) {
  Mesh wider = sheet(0);
  const Mesh more = sheet(1);
  for (const auto& t : more.triangles) wider.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  wider.vertices.insert(wider.vertices.end(), more.vertices.begin(), more.vertices.end());
  const JoinedMesh joined = join_pieces({sheet(0), wider}, 1e-6);
  EXPECT_EQ(joined.repeated, 4u);
  EXPECT_EQ(joined.mesh.triangles.size(), 8u);
  EXPECT_EQ(joined.ends, (std::vector<std::size_t>{4, 8}));
}

TEST(MeshJoin, NoPiecesAreNoMesh) { EXPECT_TRUE(join_pieces({}, 1e-6).mesh.empty()); }

}  // namespace
}  // namespace genu
