#include "genu/shape_fit/chart_choice.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"
#include "support/fitted_shapes.h"

namespace genu {
namespace {

Mesh round_sheet(double half_turn) {
  return chart_mesh({true, test::some_frame()}, {-half_turn, half_turn, -0.01, 0.01}, {{0, 0, 0.02}}, false, 1e-3);
}

TEST(ChartChoice, WrapsRoundBeyondACone) {
  EXPECT_FALSE(wraps_round(oriented_points(round_sheet(0.9))));
  EXPECT_TRUE(wraps_round(oriented_points(round_sheet(1.4))));
}

TEST(ChartChoice, FindsTheAxisOfACylinder) {
  const auto points = oriented_points(round_sheet(1.4));
  const Pose frame = axis_frame(points, normal_axes(points).front());
  const Pose truth = test::some_frame();
  EXPECT_LT(frame.R.col(2).cross(truth.R.col(2)).norm(), 1e-9);
  EXPECT_LT((frame.p - truth.p).cross(truth.R.col(2)).norm(), 1e-9);
  EXPECT_LT((frame.R.col(0) - truth.R.col(0)).norm(), 1e-3);
}

TEST(ChartChoice, AlignsWithTheLongerSide) {
  const Mesh sheet = chart_mesh({false, test::some_frame()}, {-0.02, 0.02, -0.01, 0.01}, {{0, 0, 0}}, false, 1e-3);
  SurfaceChart chart{false, {test::some_frame().R * exp_rotation(Vec3(0, 0, 0.7)), test::some_frame().p}};
  align_with_zone(sheet, chart);
  EXPECT_NEAR(std::abs(chart.X_BS.R.col(0).dot(test::some_frame().R.col(0))), 1, 1e-12);
  EXPECT_NEAR(chart.X_BS.R.determinant(), 1, 1e-12);
}

TEST(ChartChoice, CentresAndLevels) {
  SurfaceChart chart{true, test::some_frame()};
  const Vec3 p = chart.position({0.5, 0.003, 0.02});
  ChartBox box{0.2, 0.8, 0.001, 0.005};
  centre_on(box, chart);
  const ChartPoint c = chart.coordinates(p);
  EXPECT_NEAR(c.u, 0, 1e-12);
  EXPECT_NEAR(c.v, 0, 1e-12);
  EXPECT_NEAR(c.h, 0.02, 1e-12);
  EXPECT_NEAR(box.u0, -0.3, 1e-12);

  const std::vector<PolynomialTerm> slope{{0, 0, 0.002}, {1, 0, 0.3}, {0, 1, -0.2}};
  const SurfaceChart tilted{false, test::some_frame()}, level = level_chart(tilted, slope);
  SurfacePoint s;
  ASSERT_TRUE(make_polynomial(tilted.X_BS, slope, false)->project(level.X_BS.p, s));
  EXPECT_LT((s.p - level.X_BS.p).norm(), 1e-14);
  EXPECT_LT((s.n - level.X_BS.R.col(2)).norm(), 1e-12);
  EXPECT_GT(chart_difference(tilted, level, 0.02), 0.1);
  EXPECT_EQ(chart_difference(level, level, 0.02), 0);
}

}  // namespace
}  // namespace genu
