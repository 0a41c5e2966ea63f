#include "genu/mesh/vertex_triangles.h"

#include <random>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(VertexTriangles, AreThoseThatNameTheVertexInOrder) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> vertex(0, 9);  // 10 and 11 are in no triangle
  Mesh mesh;
  mesh.vertices.resize(12);
  for (int t = 0; t < 40; ++t) {
    const int a = vertex(random);
    const int b = vertex(random);
    const int c = vertex(random);
    mesh.triangles.push_back({a, b, c});
  }
  const VertexTriangles around(mesh);
  for (int v = 0; v < 12; ++v) {
    std::vector<int> plain;
    for (int t = 0; t < 40; ++t)
      for (const int w : mesh.triangles[at(t)])
        if (w == v) plain.push_back(t);
    EXPECT_EQ(std::vector<int>(around.of(v).begin(), around.of(v).end()), plain) << v;
  }
  EXPECT_TRUE(around.of(11).empty());
}

}  // namespace
}  // namespace genu
