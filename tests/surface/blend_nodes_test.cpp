// Spacing and covering of the nodes, their links, and the parting of sheets.
#include "genu/surface/blend_nodes.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/blend_meshes.h"

namespace genu {
namespace {

TEST(BlendNodes, AreSpacedAndCoverLargeFacetsToo) {
  const auto flat = [](double, double) { return 0.0; };
  for (double edge : {0.01, 0.05, 0.5}) {
    const Mesh mesh = test::jittered_patch(0.5, edge, flat);
    const double spacing = 0.06;
    const auto seeds = sample_nodes(mesh, vertex_graph(mesh), spacing);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT((seeds[i].position - seeds[j].position).norm(), 0.999 * spacing);
    }
    double farthest = 0;
    for (double x = -0.5; x <= 0.5; x += 0.02) {
      for (double y = -0.5; y <= 0.5; y += 0.02) {
        double nearest = 1;
        for (const auto& s : seeds) nearest = std::min(nearest, (s.position - Vec3(x, y, 0)).norm());
        farthest = std::max(farthest, nearest);
      }
    }
    EXPECT_LT(farthest, 2 * spacing) << "edge " << edge;
  }
}

TEST(BlendNodes, FitsNarrowWhereTheSurfaceIsSharp) {
  // A bump of radius of curvature 0.02 on a plane: fits there must narrow, fits on the plane must not.
  const Mesh mesh = test::jittered_patch(
      0.2, 0.004, [](double x, double y) { return 0.02 * std::exp(-(x * x + y * y) / (2 * 0.02 * 0.02)); });
  const VertexGraph graph = vertex_graph(mesh);
  const auto seeds = sample_nodes(mesh, graph, 0.01);
  const auto fits = fit_nodes(mesh, graph, seeds, 0.04, 0.012, 3);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const double r = seeds[i].position.head<2>().norm();
    EXPECT_GE(fits[i].radius, 0.012);
    if (r < 0.01) {
      EXPECT_LT(fits[i].radius, 0.03) << "at r = " << r;
    } else if (r > 0.12) {
      EXPECT_GE(fits[i].radius, 0.04) << "at r = " << r;
    }
  }
  for (const HeightFit& fit : fit_nodes(mesh, graph, seeds, 0.04, 0.04, 3)) EXPECT_GE(fit.radius, 0.04);
}

TEST(BlendNodes, LinksAreAllPairsWithinReach) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> draw(0, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i) points.push_back(Vec3{draw(random), draw(random), draw(random)});
  const NodeLinks links = link_nodes(points, 0.3);
  for (int i = 0; i < 200; ++i) {
    std::vector<int> expected;
    for (int j = 0; j < 200; ++j) {
      if (j != i && (points[i] - points[j]).norm() < 0.3) expected.push_back(j);
    }
    EXPECT_TRUE(std::ranges::equal(links.of(i), expected));
  }
}

std::vector<int> sheet_of_each_node(const Mesh& mesh, double spacing) {
  const auto seeds = sample_nodes(mesh, vertex_graph(mesh), spacing);
  std::vector<Vec3> positions, normals;
  std::vector<int> components;
  for (const auto& s : seeds) {
    positions.push_back(s.position);
    normals.push_back(s.normal);
    components.push_back(s.component);
  }
  const double blend_radius = 2.8 * spacing;
  return label_sheets(positions, normals, components, link_nodes(positions, 1.4 * blend_radius), blend_radius);
}

TEST(BlendNodes, AClosedRoundShapeIsOneSheetAndALensHasTwoFaces) {
  EXPECT_EQ(std::ranges::max(sheet_of_each_node(test::noisy_sphere(1, 4, 0), 0.15)), 0);
  EXPECT_EQ(std::ranges::max(sheet_of_each_node(test::jittered_torus(3, 1, 0.15), 0.2)), 0);
  Mesh lens = test::noisy_sphere(1, 5, 0);
  for (Vec3& v : lens.vertices) v.z() *= 0.08;
  const VertexGraph graph = vertex_graph(lens);
  const auto seeds = sample_nodes(lens, graph, 0.1);
  const auto sheets = sheet_of_each_node(lens, 0.1);
  int above = -1, below = -1;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (seeds[i].position.head<2>().norm() > 0.7) continue;  // the rim belongs to either
    int& face = seeds[i].normal.z() > 0 ? above : below;
    if (face < 0) face = sheets[i];
    EXPECT_EQ(sheets[i], face);
  }
  EXPECT_NE(above, below);
}

}  // namespace
}  // namespace genu
