#include "genu/mesh/mesh_cut.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/surface/samples.h"

namespace genu {
namespace {

Mesh square(int n) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.vertices.push_back(Vec3(i, j, 0) / n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

Mesh cut_along(const Mesh& mesh, const Vec3& normal, double offset) {
  const auto inside = [&](const Vec3& p) { return normal.dot(p) - offset; };
  return cut_mesh(mesh, inside, [&](const Vec3& a, const Vec3& b) -> Vec3 {
    return a + inside(a) / (inside(a) - inside(b)) * (b - a);
  });
}

double signed_area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto v = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    sum += 0.5 * (v(1) - v(0)).cross(v(2) - v(0)).z();  // signed: a triangle turned over would show
  }
  return sum;
}

TEST(CutMesh, KeepsTheAreaOnOneSideWhateverTheTriangles) {
  for (const int n : {1, 3, 10}) {
    const Mesh whole = square(n);
    EXPECT_NEAR(signed_area(cut_along(whole, {1, 0, 0}, 0.37)), 0.63, 1e-14) << n;
    EXPECT_NEAR(signed_area(cut_along(whole, {1, 1, 0}, 1.5)), 0.125, 1e-14) << n;
    EXPECT_NEAR(signed_area(cut_along(cut_along(whole, {1, 0, 0}, 0.37), {-1, 0, 0}, -0.6)), 0.23, 1e-14) << n;
    EXPECT_NEAR(signed_area(cut_along(whole, {1, 0, 0}, -1)), 1, 1e-14) << n;
    EXPECT_TRUE(cut_along(whole, {1, 0, 0}, 2).triangles.empty()) << n;
    EXPECT_TRUE(cut_along(whole, {1, 0, 0}, 2).vertices.empty()) << n;
  }
}

TEST(CutMesh, StaysOneSheetWithoutCracks) {
  const Mesh part = cut_along(square(7), Vec3(1, 0.3, 0), 0.61);
  const auto edges = mesh_edges(part);
  for (const MeshEdge& e : edges) EXPECT_LE(e.count, 2);
  EXPECT_EQ(boundary_loops(part, edges).size(), 1u);
}

TEST(CutMesh, LeavesNoSlivers) {
  double smallest = 1;
  for (int k = 0; k <= 100; ++k) {
    // From one row of vertices to the next, exactly through both.
    const Mesh part = cut_along(cut_along(square(8), Vec3(1, 0, 0), 0.25 + 0.125 * k / 100), {0.1, 1, 0}, 0.3);
    for (const MeshEdge& e : mesh_edges(part))
      smallest = std::min(
          smallest,
          (part.vertices[static_cast<std::size_t>(e.v[0])] - part.vertices[static_cast<std::size_t>(e.v[1])]).norm());
  }
  EXPECT_GT(8 * smallest, 0.01);  // a tenth of a tenth where both cuts meet
  std::printf("  shortest edge %.3f of the mesh's\n", 8 * smallest);
}

}  // namespace
}  // namespace genu
