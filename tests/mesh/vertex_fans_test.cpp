#include "genu/mesh/vertex_fans.h"

#include <gtest/gtest.h>

#include "support/blend_meshes.h"

namespace genu {
namespace {

/// Two tetrahedra that share one vertex.
Mesh bow_tie() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {0, 5, 6}}};
}

TEST(VertexFans, PartWhatTouchesInAVertex) {
  Mesh mesh = bow_tie();
  EXPECT_EQ(split_fans(mesh), 1u);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.vertices[7], mesh.vertices[0]);
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(split_fans(mesh), 0u);
}

TEST(VertexFans, LeaveCleanMeshesAlone) {
  const Mesh clean = test::noisy_sphere(10e-3, 2, 0);
  Mesh mesh = clean;
  EXPECT_EQ(split_fans(mesh), 0u);
  EXPECT_EQ(drop_small_fans(mesh), 0u);
  EXPECT_EQ(mesh.triangles, clean.triangles);
}

TEST(VertexFans, DropTheSmallerFanUntilNoneIsLeft) {
  Mesh mesh = test::noisy_sphere(10e-3, 2, 0);
  const std::size_t whole = mesh.triangles.size();
  // All but two opposite triangles round a vertex.
  std::vector<std::size_t> round;
  for (std::size_t t = 0; t < whole; ++t)
    if (mesh.triangles[t][0] == 0 || mesh.triangles[t][1] == 0 || mesh.triangles[t][2] == 0) round.push_back(t);
  ASSERT_EQ(round.size(), 5u);
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(round[4]));
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(round[1]));
  Mesh pinched = mesh;
  EXPECT_EQ(split_fans(pinched), 1u);
  EXPECT_GT(drop_small_fans(mesh), 0u);
  EXPECT_EQ(split_fans(mesh), 0u);
}

}  // namespace
}  // namespace genu
