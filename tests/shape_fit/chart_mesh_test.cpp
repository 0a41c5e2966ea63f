#include "genu/shape_fit/chart_mesh.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/shape_fit/tolerances.h"
#include "genu/surface/tessellate.h"
#include "support/fitted_shapes.h"

namespace genu {
namespace {

class ChartMeshes : public testing::TestWithParam<bool> {};

TEST_P(ChartMeshes, LieOnTheSurfaceAndEndAtThePatch) {
  const SurfaceChart chart{GetParam(), test::some_frame()};
  const ChartBox box = GetParam() ? ChartBox{-1.3, 1.2, -0.011, 0.010} : ChartBox{-0.017, 0.015, -0.012, 0.011};
  const auto terms = GetParam() ? test::condyle_terms() : test::plateau_terms();
  const auto surface =
      GetParam() ? make_cylindrical_polynomial(chart.X_BS, terms, false) : make_polynomial(chart.X_BS, terms, false);
  for (const double edge : {3e-3, 1e-3, 0.4e-3}) {
    const Mesh mesh = chart_mesh(chart, box, terms, false, edge);
    const auto edges = mesh_edges(mesh);
    const std::vector<bool> border = boundary_vertices(mesh, edges);
    double off = 0, inside = 0, longest = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      off = std::max(off, std::abs(*surface->gap(mesh.vertices[v])));
      if (!border[v]) continue;
      const ChartPoint c = chart.coordinates(mesh.vertices[v]);
      inside = std::max(inside, std::min({std::abs(c.u - box.u0), std::abs(c.u - box.u1), std::abs(c.v - box.v0) / 0.02,
                                          std::abs(c.v - box.v1) / 0.02}));
    }
    for (const MeshEdge& e : edges)
      longest = std::max(
          longest,
          (mesh.vertices[static_cast<std::size_t>(e.v[0])] - mesh.vertices[static_cast<std::size_t>(e.v[1])]).norm());
    EXPECT_LT(off, 1e-15);
    EXPECT_LT(inside, 1e-12);  // border vertices are on a side, to rounding
    EXPECT_LT(longest, 1.35 * edge);
    EXPECT_GT(longest, 0.8 * edge);
    EXPECT_EQ(boundary_loops(mesh, edges).size(), 1u);
    EXPECT_GT(smallest_angle(mesh), 10 * std::numbers::pi / 180);
    const std::vector<Vec3> normals = vertex_normals(mesh);
    for (std::size_t v = 0; v < normals.size(); ++v) {
      SurfacePoint s;
      ASSERT_TRUE(surface->project(mesh.vertices[v], s));
      EXPECT_GT(s.n.dot(normals[v]), 0.9);
    }
  }
  const Mesh out = chart_mesh(chart, box, terms, false, 1e-3), in = chart_mesh(chart, box, terms, true, 1e-3);
  EXPECT_EQ(out.triangles[5][1], in.triangles[5][2]);
}

INSTANTIATE_TEST_SUITE_P(BothCharts, ChartMeshes, testing::Bool());

TEST(ChartMesh, ASurfaceAsSteepAsAWallStaysAffordable) {
  const ChartBox box{-2.3, 0.7, -0.013, 0.013};
  for (const double steep : {1.0, 1e6, 1e16}) {
    for (const bool cylindrical : {false, true}) {
      const Mesh mesh = chart_mesh({cylindrical, Pose()}, box, {{0, 0, 0.02}, {2, 0, steep}}, false, 1e-3);
      EXPECT_FALSE(mesh.triangles.empty());
      EXPECT_LT(static_cast<double>(mesh.triangles.size()), 1.5 * kMaxChartTriangles) << steep;
      for (const Vec3& v : mesh.vertices) ASSERT_TRUE(v.allFinite());
    }
  }
  EXPECT_TRUE(chart_mesh({false, Pose()}, box, {{9, 9, 1e300}, {0, 9, 1e300}}, false, 1e-3).triangles.empty());
}

}  // namespace
}  // namespace genu
