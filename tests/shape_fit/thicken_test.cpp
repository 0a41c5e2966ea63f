#include "genu/shape_fit/thicken.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/surface/analytic.h"
#include "support/fitted_shapes.h"

namespace genu {
namespace {

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto p = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += p(0).dot(p(1).cross(p(2))) / 6;
  }
  return sum;
}

TEST(Thicken, MakesASolidOfTheRightVolumeWithNormalsOut) {
  const double R = 0.02, t = 0.002, half = 1.1, width = 0.02;
  const SurfaceChart chart{true, test::some_frame()};
  const std::vector<PolynomialTerm> terms{{0, 0, R}};
  const Mesh sheet = chart_mesh(chart, {-half, half, -width / 2, width / 2}, terms, false, 0.4e-3);
  std::string why;
  const Mesh solid = thicken(sheet, *make_cylindrical_polynomial(chart.X_BS, terms, false), t, 0.4e-3, why);
  EXPECT_EQ(why, "");
  for (const MeshEdge& e : mesh_edges(solid)) EXPECT_EQ(e.count, 2);
  Mesh copy = solid;
  EXPECT_EQ(make_winding_consistent(copy, mesh_edges(solid)).flipped, 0u);
  EXPECT_NEAR(volume(solid) / (half * width * (R * R - (R - t) * (R - t))), 1, 1e-3);
}

TEST(Thicken, LeavesClosedMeshesAndRefusesFolds) {
  const auto ball = make_sphere({}, 0.01, false);
  const Mesh closed = ball->triangles(2e-3, Vec3::Zero(), 0.05);
  std::string why;
  EXPECT_EQ(thicken(closed, *ball, 1e-3, 1e-3, why).triangles.size(), closed.triangles.size());
  const SurfaceChart chart{true, test::some_frame()};
  const std::vector<PolynomialTerm> terms{{0, 0, 0.005}};
  const Mesh sheet = chart_mesh(chart, {-1, 1, -0.01, 0.01}, terms, false, 1e-3);
  EXPECT_TRUE(thicken(sheet, *make_cylindrical_polynomial(chart.X_BS, terms, false), 0.006, 1e-3, why).empty());
  EXPECT_NE(why.find("5 mm"), std::string::npos) << why;
}

}  // namespace
}  // namespace genu
