#include "genu/mesh/mesh_coarsen.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_check.h"
#include "genu/mesh_files/mesh_reader.h"
#include "support/blend_meshes.h"
#include "support/data.h"

namespace genu {
namespace {

/// V - E + T
long euler(const Mesh& mesh) {
  return static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh_edges(mesh).size()) +
         static_cast<long>(mesh.triangles.size());
}

double median_edge(const Mesh& mesh) { return median_edge_length(mesh, mesh_edges(mesh)); }

/// What holds for any coarser mesh of a clean one.
void expect_same_sheet(const Mesh& fine, const Mesh& coarse) {
  const MeshReport before = check_mesh(fine), after = check_mesh(coarse);
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(after.boundary_loops, before.boundary_loops);
  EXPECT_EQ(after.non_manifold_edges, 0u);
  EXPECT_EQ(after.flipped, 0u);
  EXPECT_EQ(after.degenerate, 0u);
  EXPECT_EQ(euler(coarse), euler(fine));
  std::size_t next = 0;  // a subset, in the same order
  for (const Vec3& v : coarse.vertices) {
    while (next < fine.vertices.size() && fine.vertices[next] != v) ++next;
    ASSERT_LT(next, fine.vertices.size());
  }
}

TEST(MeshCoarsen, ATorusGetsLongerEdgesAndStaysWhole) {
  const Mesh fine = test::jittered_torus(15e-3, 5e-3, 0.5e-3);
  for (const double factor : {1.0, 1.4, 2.0, 3.0}) {
    const Mesh coarse = coarsened(fine, factor);
    EXPECT_NEAR(static_cast<double>(coarse.vertices.size()),
                static_cast<double>(fine.vertices.size()) / factor / factor, 1.0);
    EXPECT_NEAR(median_edge(coarse) / median_edge(fine), factor, 0.1 * factor);
    expect_same_sheet(fine, coarse);
  }
}

TEST(MeshCoarsen, AnOpenSheetKeepsItsEdge) {
  const Mesh fine = test::jittered_patch(10e-3, 0.5e-3, [](double x, double y) { return 5 * x * x - 8 * y * y; });
  const Mesh coarse = coarsened(fine, 2.5);
  expect_same_sheet(fine, coarse);
  const BoundingBox before = bounding_box(fine), after = bounding_box(coarse);
  EXPECT_LT((before.low - after.low).head<2>().norm(), 0.2e-3) << "the boundary is straight: it stays where it was";
  EXPECT_LT((before.high - after.high).head<2>().norm(), 0.2e-3);
}

TEST(MeshCoarsen, NothingIsLeftToDrawTogetherInATetrahedron) {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_EQ(coarsened(mesh, 10).triangles.size(), 4u);
}

TEST(MeshCoarsen, MoreThanTwoTrianglesAtAnEdgeStay) {
  Mesh mesh = test::jittered_patch(5e-3, 0.5e-3, [](double, double) { return 0.0; });
  const auto edges = mesh_edges(mesh);
  const auto inner = std::find_if(edges.begin(), edges.end(), [](const MeshEdge& e) { return e.count == 2; });
  const std::array<int, 2> ends = inner->v;
  const Vec3 a = mesh.vertices[static_cast<std::size_t>(ends[0])], b = mesh.vertices[static_cast<std::size_t>(ends[1])];
  mesh.vertices.emplace_back(0.5 * (a + b) + Vec3(0, 0, 1e-3));
  mesh.triangles.push_back({ends[0], ends[1], static_cast<int>(mesh.vertices.size()) - 1});
  const Mesh coarse = coarsened(mesh, 3);
  EXPECT_EQ(check_mesh(coarse).non_manifold_edges, 1u);
  EXPECT_LT(coarse.vertices.size(), mesh.vertices.size() / 5);
}

TEST(MeshCoarsen, RealCartilageStaysAClosedShell) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  Diagnostics out;
  const auto mesh = read_mesh(test::data_path("lenhart2015/ACLC01-R-femur-cart.stl"), 1, out);
  ASSERT_TRUE(mesh);
  const MeshReport before = check_mesh(*mesh);
  const Mesh coarse = coarsened(*mesh, 2);
  const MeshReport after = check_mesh(coarse);
  EXPECT_NEAR(after.edge_length[2] / before.edge_length[2], 2, 0.2);
  EXPECT_EQ(after.boundary_loops, before.boundary_loops);
  EXPECT_EQ(after.components, before.components);
}

}  // namespace
}  // namespace genu
