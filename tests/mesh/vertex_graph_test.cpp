// Neighbours, boundary, areas and normals against shapes whose answers are known.
#include "genu/mesh/vertex_graph.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "support/blend_meshes.h"

namespace genu {
namespace {

TEST(VertexGraph, KnowsASphere) {
  const VertexGraph graph = vertex_graph(test::noisy_sphere(1, 3, 0));
  const int vertices = static_cast<int>(graph.normals.size());
  EXPECT_TRUE(graph.boundary.empty());
  EXPECT_EQ(graph.adjacent.size(), 2u * static_cast<std::size_t>(3 * vertices - 6));  // Euler
  EXPECT_EQ(*std::max_element(graph.component.begin(), graph.component.end()), 0);
  EXPECT_NEAR(std::accumulate(graph.areas.begin(), graph.areas.end(), 0.0), graph.area, 1e-12);
  EXPECT_NEAR(graph.area, 2 * test::kTwoPi, 0.02 * graph.area);
  const Mesh mesh = test::noisy_sphere(1, 3, 0);
  for (int v = 0; v < vertices; ++v) {
    EXPECT_GT(graph.normals[v].dot(mesh.vertices[v]), 0.999);
    for (int w : graph.neighbours(v)) EXPECT_TRUE(std::ranges::count(graph.neighbours(w), v));
  }
}

TEST(VertexGraph, KnowsAnOpenPatchAndStrayVertices) {
  const auto flat = [](double, double) { return 0.0; };
  Mesh mesh = test::joined(test::jittered_patch(1, 0.1, flat), test::jittered_patch(1, 0.1, flat, true));
  mesh.vertices.emplace_back(5, 5, 5);
  const VertexGraph graph = vertex_graph(mesh);
  EXPECT_EQ(graph.boundary.size(), 2u * 80u);
  EXPECT_EQ(graph.component.front(), 0);
  EXPECT_EQ(graph.component[mesh.vertices.size() - 2], 1);
  EXPECT_EQ(graph.component.back(), -1);
  EXPECT_TRUE(graph.normals.back().isZero());
  EXPECT_GT(graph.normals.front().z(), 0.99);
  EXPECT_LT(graph.normals[mesh.vertices.size() - 2].z(), -0.99);
  for (const auto& [from, to, triangle] : graph.boundary) {
    const auto& t = mesh.triangles[triangle];
    const auto at = std::find(t.begin(), t.end(), from) - t.begin();
    EXPECT_EQ(t[(at + 1) % 3], to);  // the triangle lies on the left
  }
}

}  // namespace
}  // namespace genu
