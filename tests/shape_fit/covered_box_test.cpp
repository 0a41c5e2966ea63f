#include "genu/shape_fit/covered_box.h"

#include <gtest/gtest.h>

#include "genu/mesh/mesh_part.h"
#include "support/fitted_shapes.h"

namespace genu {
namespace {

const SurfaceChart kChart{false, test::some_frame()};

Mesh parabolic_sheet() { return chart_mesh(kChart, {-0.02, 0.01, -0.012, 0.008}, {{2, 0, 3}}, false, 0.5e-3); }

TEST(CoveredBox, ARectangleIsItself) {
  const auto found = covered_box(parabolic_sheet(), kChart, std::nullopt, std::nullopt);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->box.u0, -0.02, 1e-15);
  EXPECT_NEAR(found->box.u1, 0.01, 1e-15);
  EXPECT_NEAR(found->box.v0, -0.012, 1e-15);
  EXPECT_NEAR(found->box.v1, 0.008, 1e-15);
  EXPECT_EQ(found->covered, 1);
}

TEST(CoveredBox, KeepsOffABiteUnlessItHasTo) {
  const Mesh bitten = part_of(parabolic_sheet(), [](const Vec3& p, const Vec3&) {
    const ChartPoint c = kChart.coordinates(p);
    return !(c.u > 0.002 && c.v > 0.001);  // a corner is missing
  });
  const auto free = covered_box(bitten, kChart, std::nullopt, std::nullopt);
  ASSERT_TRUE(free);
  EXPECT_GT(free->covered, 0.95);
  EXPECT_FALSE(free->box.contains(0.005, 0.005));
  const auto held = covered_box(bitten, kChart, std::nullopt, ChartBox{-0.015, 0.005, -0.01, 0.004});
  ASSERT_TRUE(held);
  EXPECT_TRUE(held->box.contains(0.005, 0.004) && held->box.contains(-0.015, -0.01));
  EXPECT_LT(held->covered, free->covered);
  const auto limited = covered_box(bitten, kChart, ChartBox{-0.01, 0, -0.005, 0}, std::nullopt);
  ASSERT_TRUE(limited);
  EXPECT_NEAR(limited->box.u0, -0.01, 1e-15);
  EXPECT_NEAR(limited->box.u1, 0, 1e-15);
}

TEST(CoveredBox, NothingHasNone) {
  EXPECT_FALSE(covered_box({}, kChart, std::nullopt, std::nullopt));
  EXPECT_FALSE(covered_box(parabolic_sheet(), kChart, ChartBox{1, 2, 1, 2}, std::nullopt));
}

}  // namespace
}  // namespace genu
