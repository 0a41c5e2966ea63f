#include "genu/mesh/sharp_corners.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "genu/mesh_care/mesh_flaws.h"
#include "genu/shape_fit/chart_mesh.h"
#include "genu/shape_fit/thicken.h"
#include "genu/surface/analytic.h"
#include "genu/surface/polynomial_surface.h"
#include "support/dirt.h"
#include "support/fitted_shapes.h"

namespace genu {
namespace {

std::size_t spikes(Mesh mesh) {
  const auto flaws = cut_out_flaws(mesh);
  return static_cast<std::size_t>(
      std::count_if(flaws.begin(), flaws.end(), [](const Flaw& f) { return f.kind == Flaw::Kind::spike; }));
}

TEST(SharpCorners, OfAThickenedSheetAreNoSpikes) {
  const Pose frame = test::some_frame();
  const auto terms = test::plateau_terms();
  const Mesh sheet = chart_mesh({false, frame}, {-0.01, 0.01, -0.008, 0.008}, terms, false, 1e-3);
  const auto surface = make_polynomial(frame, terms, false);
  for (const double thickness : {1e-3, 2e-3, 4e-3}) {
    std::string why;
    const Mesh solid = thicken(sheet, *surface, thickness, 1e-3, why);
    ASSERT_EQ(why, "");
    EXPECT_EQ(spikes(solid), 0u) << thickness;
    const SharpCorners corners(solid, mesh_edges(solid));
    int count = 0;
    for (int v = 0; v < static_cast<int>(solid.vertices.size()); ++v) count += corners.is_corner(v) ? 1 : 0;
    EXPECT_EQ(count, 8) << "as a box has";
  }
}

TEST(SharpCorners, ASpikeIsNone) {
  const Mesh torus = make_torus({}, 0.015, 0.005, false)->triangles(1e-3, Vec3::Zero(), 1);
  const Mesh dirty = test::dirtied(torus, test::Dirt::spike, {0.02, 0, 0}, 2e-3);
  EXPECT_EQ(spikes(dirty), 1u);
  const SharpCorners corners(dirty, mesh_edges(dirty));
  int moved = 0;
  for (std::size_t v = 0; v < torus.vertices.size(); ++v) {
    if (dirty.vertices[v] == torus.vertices[v]) continue;
    EXPECT_FALSE(corners.is_corner(static_cast<int>(v)));
    ++moved;
  }
  EXPECT_EQ(moved, 1);
}

}  // namespace
}  // namespace genu
