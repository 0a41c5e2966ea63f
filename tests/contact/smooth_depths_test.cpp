// Depths of nodes beside those that a line of its own gives each, on the surface itself.
#include "genu/contact/smooth_depths.h"

#include <cmath>

#include <gtest/gtest.h>

#include "contact/layer_shapes.h"
#include "support/layers.h"

namespace genu::depth_tests {
namespace {

using namespace layer_tests;

struct Between {
  std::shared_ptr<const SmoothCells> casting, target;
  SmoothDepths depths;
};

Between between(const Mesh& mine, const std::shared_ptr<const Surface>& own, const Mesh& theirs,
                const std::shared_ptr<const Surface>& other) {
  const auto casting = std::make_shared<const SmoothCells>(mine, own),
             target = std::make_shared<const SmoothCells>(theirs, other);
  return {casting, target,
          SmoothDepths(casting, target, std::make_shared<const TriangleTree>(theirs), 5e-3,
                       LayerLaw{LayerLaw::Kind::linear, 1e7}, LayerThickness{5e-3, nullptr, nullptr})};
}

/// From a plane to a bowl.
Between onto(const Bowl& bowl, double edge) {
  const std::shared_ptr<const Surface> plane = make_plane({}, false);
  return between(plane->triangles(edge, Vec3::Zero(), 15e-3), plane, bowl.surface->triangles(edge, Vec3::Zero(), 15e-3),
                 bowl.surface);
}

Pose pressed_in() { return Pose{exp_rotation(Vec3(0, 0, 0.3)), Vec3(0.1e-3, 0.2e-3, -1e-3)}.inverse(); }

TEST(SmoothDepths, AreThoseOfALineOfTheirOwn) {
  for (const int divisions : {2, 4}) {
    const Between b = onto(torus(20e-3, 15e-3), 2e-3);
    LayerQuadrature::Memory memory;
    const Pose X = pressed_in();
    b.depths.begin(X, divisions, memory);
    int inside = 0, outside = 0;
    double worst = 0;
    for (const int cell : memory.nodes.reached)
      for (int j = 0; j <= divisions; ++j)
        for (int i = 0; i + j <= divisions; ++i) {
          const SmoothCells::Place place{cell, divisions, i, j};
          const SmoothNode node = b.depths.node(X, place, b.depths.index(place, memory.nodes), memory);
          const auto twin = b.depths.measure(X, {node.x, node.n}, -1);
          if (!twin.met) continue;  // its line begins further out only
          ASSERT_TRUE(node.met);
          worst = std::max(worst, std::abs(node.depth - twin.depth));
          Vec6 rate;
          rate << twin.w, (node.x - twin.depth * node.n).cross(twin.w);
          EXPECT_LT((node.p_rate - node.slope * rate).norm(), (divisions == 2 ? 3e-3 : 1e-7) * node.slope);
          ++(node.depth > 0 ? inside : outside);
        }
    EXPECT_GT(inside, 100) << divisions;
    EXPECT_GT(outside, 20) << divisions;
    EXPECT_LT(worst, divisions == 2 ? 1e-7 : 1e-13) << divisions;
  }
}

TEST(SmoothDepths, ListsEveryCellThatTouches) {
  const Between b = onto(sphere(25e-3), 1.5e-3);
  LayerQuadrature::Memory memory;
  for (const double delta : {-0.1e-3, 0.02e-3, 0.4e-3, 2e-3}) {
    const Pose X = Pose{Mat3::Identity(), Vec3(0.2e-3, 0.1e-3, -delta)}.inverse();
    b.depths.begin(X, 2, memory);
    int touching = 0;
    for (int cell = 0; cell < b.casting->cell_count(); ++cell) {
      double deepest = -1;
      for (int k = 0; k < 3; ++k) {
        const Vec3 x = X * b.casting->corner(cell, k);
        deepest = std::max(deepest, 25e-3 - (x - Vec3(0, 0, 25e-3)).norm());
      }
      if (!(deepest > 0)) continue;
      ++touching;
      const auto& reached = memory.nodes.reached;
      EXPECT_NE(std::find(reached.begin(), reached.end(), cell), reached.end()) << cell << " at " << delta;
    }
    EXPECT_EQ(touching > 0, delta > 0) << delta;
  }
}

/// Where the target is thinner than the distance at which lines begin, they begin beyond it.
TEST(SmoothDepths, AThinPlateIsMetFromOutside) {
  // A plate of 0.4 mm, cut into triangles of 3 mm: its upper and its lower side.
  Mesh plate = test::sheet(15e-3, 10);
  const int count = static_cast<int>(plate.vertices.size());
  const std::size_t upper = plate.triangles.size();
  for (int v = 0; v < count; ++v)
    plate.vertices.push_back(plate.vertices[static_cast<std::size_t>(v)] - 0.4e-3 * Vec3::UnitZ());
  for (std::size_t t = 0; t < upper; ++t) {
    const auto c = plate.triangles[t];
    plate.triangles.push_back({c[0] + count, c[2] + count, c[1] + count});
  }
  // The casting sheet looks down into it from 0.1 mm under its upper side.
  const auto surface = std::shared_ptr<const Surface>(make_plane({}, false));
  const Mesh sheet = test::sheet(10e-3, 7);
  const auto lower =
      std::shared_ptr<const Surface>(make_plane({Mat3(Vec3(1, -1, -1).asDiagonal()), {0, 0, -0.4e-3}}, false));
  const Between b = between(sheet, surface, plate, lower);
  LayerQuadrature::Memory memory;
  const Pose X{Mat3::Identity(), Vec3(0.1e-3, 0.2e-3, -0.1e-3)};
  b.depths.begin(X, 4, memory);
  int met = 0;
  for (const CornerHit& hit : memory.nodes.corners) {
    if (hit.pose != memory.nodes.pose) continue;
    ++met;
    EXPECT_NEAR(hit.depth, 0.3e-3, 1e-12);
  }
  EXPECT_EQ(met, static_cast<int>(b.casting->corners().size()));
}

}  // namespace
}  // namespace genu::depth_tests
