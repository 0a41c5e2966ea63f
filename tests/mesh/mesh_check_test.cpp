#include "genu/mesh/mesh_check.h"

#include <gtest/gtest.h>

#include "genu/surface/tessellate.h"

namespace genu {
namespace {

Mesh flat_sheet() {
  return grid_mesh({8, false}, {6, false}, [](double s, double t) { return Vec3(0.08 * s, 0.06 * t, 0); });
}

TEST(MeshCheck, ASoundSheet) {
  const MeshReport r = check_mesh(flat_sheet());
  EXPECT_EQ(r.vertices, 63u);
  EXPECT_EQ(r.triangles, 96u);
  EXPECT_EQ(r.components, 1);
  EXPECT_EQ(r.boundary_loops, 1u);
  EXPECT_EQ(r.boundary_edges, 28u);
  EXPECT_EQ(r.non_manifold_edges + r.flipped + r.degenerate + r.slivers, 0u);
  EXPECT_TRUE(r.orientable);
  EXPECT_NEAR(r.edge_length[0], 0.01, 1e-15);
  EXPECT_NEAR(r.edge_length[4], 0.01 * std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(r.box.diagonal(), 0.1, 1e-15);
}

TEST(MeshCheck, AFlippedPatch) {
  Mesh mesh = flat_sheet();
  for (std::size_t t = 10; t < 25; ++t) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const MeshReport r = check_mesh(mesh);
  EXPECT_EQ(r.flipped, 15u);
  EXPECT_TRUE(r.orientable);
}

TEST(MeshCheck, AFinOnASheet) {
  Mesh mesh = flat_sheet();
  mesh.vertices.emplace_back(0.045, 0.03, 0.01);
  const auto t = mesh.triangles[50];
  mesh.triangles.push_back({t[0], t[1], static_cast<int>(mesh.vertices.size()) - 1});
  const MeshReport r = check_mesh(mesh);
  EXPECT_EQ(r.non_manifold_edges, 1u);
  EXPECT_EQ(r.components, 1);
}

TEST(MeshCheck, ASheetTornIntoTriangles) {
  const Mesh whole = flat_sheet();
  Mesh torn;
  for (const auto& t : whole.triangles) {
    const int first = static_cast<int>(torn.vertices.size());
    for (const int v : t) torn.vertices.push_back(whole.vertices[static_cast<std::size_t>(v)]);
    torn.triangles.push_back({first, first + 1, first + 2});
  }
  const MeshReport r = check_mesh(torn);
  EXPECT_EQ(r.components, 96);
  EXPECT_EQ(r.boundary_edges, 3u * 96);
}

TEST(MeshCheck, SliversAndTrianglesWithoutArea) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {0.01, 0, 0}, {0.02, 0, 0}, {0.01, 0.0005, 0}, {0.01, 0.01, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}};
  const MeshReport r = check_mesh(mesh);
  EXPECT_EQ(r.degenerate, 1u);
  EXPECT_EQ(r.slivers, 1u);
}

TEST(MeshCheck, EmptyMesh) {
  const MeshReport r = check_mesh(Mesh{});
  EXPECT_EQ(r.triangles, 0u);
  EXPECT_EQ(r.components, 0);
}

// What check_scale says of a surface `size` (m) across.
std::string scale(double size, const std::string& unit) {
  MeshReport report;
  report.box.high = Vec3(size, 0, 0);
  Diagnostics out;
  check_scale(report, "femur.stl", unit, out);
  return out.items().empty() ? "" : to_string(out.items().front());
}

TEST(MeshCheck, AThousandTimesTooBigOrSmallIsAnErrorThatNamesTheUnit) {
  EXPECT_EQ(scale(0.1, "mm"), "");
  EXPECT_EQ(scale(0.006, "m"), "");
  EXPECT_EQ(scale(100, "m").find("femur.stl: read in m"), 0u) << scale(100, "m");
  EXPECT_NE(scale(100, "m").find("write units = \"mm\""), std::string::npos) << scale(100, "m");
  EXPECT_EQ(scale(1e-4, "mm").find("femur.stl: read in mm"), 0u);
  EXPECT_NE(scale(1e-4, "mm").find("write units = \"m\""), std::string::npos) << scale(1e-4, "mm");
  EXPECT_EQ(scale(1, "mm").find("femur.stl: warning"), 0u) << scale(1, "mm");
  EXPECT_NE(scale(1e-9, "m").find("check the file's units"), std::string::npos);
  EXPECT_NE(scale(0, "m"), "");
}

}  // namespace
}  // namespace genu
