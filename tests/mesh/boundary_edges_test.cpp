// Distance to the edge of a patch against closed forms, on a disc whose outline is convex and a bent patch.
#include "genu/mesh/boundary_edges.h"

#include <gtest/gtest.h>

#include "support/blend_meshes.h"

namespace genu {
namespace {

TEST(BoundaryEdges, MeasureAPolygon) {
  // A fan of triangles: the distance to a regular polygon from inside is the least distance to its sides.
  const int sides = 12;
  Mesh fan;
  fan.vertices.emplace_back(0, 0, 0);
  for (int k = 0; k < sides; ++k) {
    const double a = test::kTwoPi * k / sides;
    fan.vertices.emplace_back(std::cos(a), std::sin(a), 0);
    fan.triangles.push_back({0, k + 1, (k + 1) % sides + 1});
  }
  const double cap = 0.4, inner = std::cos(test::kTwoPi / sides / 2);
  const BoundaryEdges edges(fan, vertex_graph(fan), cap);
  for (int k = 0; k < sides; ++k) {
    const double a = test::kTwoPi * (k + 0.5) / sides;
    const Vec3 out(std::cos(a), std::sin(a), 0), corner = fan.vertices[k + 1];
    EXPECT_NEAR(edges.signed_distance((inner - 0.1) * out, 0), 0.1, 1e-14);
    EXPECT_NEAR(edges.signed_distance((inner + 0.1) * out, 0), -0.1, 1e-14);
    EXPECT_NEAR(edges.signed_distance(1.1 * corner, 0), -0.1, 1e-14);
    EXPECT_NEAR(edges.signed_distance((inner - 0.1) * out + 0.02 * Vec3::UnitZ(), 0), 0.1, 1e-14);  // off the plane
  }
  EXPECT_EQ(edges.signed_distance(Vec3::Zero(), 0), cap);
  EXPECT_EQ(edges.signed_distance(Vec3(inner, 0, 0), 1), cap);  // another component's edges do not count
}

TEST(BoundaryEdges, AreEmptyOnAClosedMesh) {
  const Mesh sphere = test::noisy_sphere(1, 2, 0);
  EXPECT_TRUE(BoundaryEdges(sphere, vertex_graph(sphere), 1).empty());
}

}  // namespace
}  // namespace genu
