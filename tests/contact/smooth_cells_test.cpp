// The lattice on a surface: one number for each place, the same from every cell that shares it, and every node on the
// surface.
#include "genu/contact/smooth_cells.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"
#include "genu/surface/facet_surface.h"
#include "support/layers.h"

namespace genu {
namespace {

constexpr double kRadius = 0.02;

SmoothCells ball_cells() { return {test::ball(kRadius, 4e-3), make_sphere({}, kRadius, false)}; }

/// Calls visit(place) for every place of the lattice of every cell.
template <typename Visit>
void each_place(const SmoothCells& cells, int divisions, Visit visit) {
  for (int cell = 0; cell < cells.cell_count(); ++cell)
    for (int j = 0; j <= divisions; ++j)
      for (int i = 0; i + j <= divisions; ++i) visit(SmoothCells::Place{cell, divisions, i, j});
}

TEST(SmoothCells, OneNumberForEachNodeAndOneNodeForEachNumber) {
  const SmoothCells cells = ball_cells();
  for (const int n : {1, 2, 4, 8}) {
    std::map<int, Vec3> found;
    each_place(cells, n, [&](const SmoothCells::Place& p) {
      const int number = cells.number(p);
      ASSERT_GE(number, 0);
      ASSERT_LT(number, cells.node_count(n));
      const Vec3 x = cells.node(p, 0).x;
      const auto known = found.emplace(number, x).first;
      EXPECT_EQ(known->second, x) << "cell " << p.cell << " (" << p.i << ", " << p.j << ") of " << n;
    });
    EXPECT_EQ(static_cast<int>(found.size()), cells.node_count(n)) << n;
    std::set<std::array<double, 3>> places;
    for (const auto& [number, x] : found) places.insert({x[0], x[1], x[2]});
    EXPECT_EQ(places.size(), found.size()) << n;
    // Euler: a closed mesh of F triangles has F / 2 + 2 vertices; cut n times it has n^2 F of them.
    EXPECT_EQ(cells.node_count(n), n * n * cells.cell_count() / 2 + 2);
  }
}

TEST(SmoothCells, CoarseNodesAreAmongTheFineOnes) {
  const SmoothCells cells = ball_cells();
  each_place(cells, 4, [&](const SmoothCells::Place& p) {
    const SmoothCells::Place fine{p.cell, 8, 2 * p.i, 2 * p.j};
    EXPECT_EQ(cells.node(p, 0).x, cells.node(fine, 0).x) << p.cell;
  });
}

TEST(SmoothCells, NodesLieOnTheSurfaceWithItsNormals) {
  const SmoothCells cells = ball_cells();
  double off = 0, turned = 0;
  each_place(cells, 8, [&](const SmoothCells::Place& p) {
    const SmoothCells::Node node = cells.node(p, 2e-3);
    off = std::max(off, std::abs(node.x.norm() - kRadius));
    turned = std::max(turned, (node.n - node.x.normalized()).norm());
  });
  EXPECT_LT(off, 1e-16);
  EXPECT_LT(turned, 1e-15);
}

TEST(SmoothCells, TheBallRoundTheMiddleHoldsEveryLine) {
  const SmoothCells cells = ball_cells();
  for (const double length : {0.0, 1e-3, 6e-3})
    each_place(cells, 8, [&](const SmoothCells::Place& p) {
      const SmoothCells::Node middle = cells.middle(p.cell), node = cells.node(p, length);
      for (const double s : {-length, 0.0, length})
        EXPECT_LE((node.x + s * node.n - (middle.x + s * middle.n)).norm(), cells.radius(p.cell, middle, length))
            << p.cell << " " << s;
    });
}

TEST(SmoothCells, WhereTheSurfaceIsNotKnownTheMeshStaysAsItIs) {
  const Mesh mesh = test::sheet(0.01, 3);
  const SmoothCells cells(mesh, std::make_shared<FacetSurface>(mesh));
  each_place(cells, 4, [&](const SmoothCells::Place& p) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(p.cell)];
    const auto l = SmoothCells::shares(p);
    Vec3 flat = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) flat += l[k] * mesh.vertices[static_cast<std::size_t>(t[k])];
    const SmoothCells::Node node = cells.node(p, 1e-3);
    EXPECT_LT((node.x - flat).norm(), 1e-17);
    EXPECT_EQ(node.n, Vec3::UnitZ());
  });
}

}  // namespace
}  // namespace genu
