// The judge's own table curve: through its points, never beyond its neighbours, with the slopes of the paper.
#include "genu/judge/curve.h"

#include <gtest/gtest.h>

namespace genu::judge {
namespace {

TEST(Curve, GoesThroughItsPointsAndNeverBeyondThem) {
  const Points points = {{0, 0}, {0.1, 0}, {0.2, 5}, {0.5, 6}, {0.6, 30}};
  for (const auto& [x, y] : points) EXPECT_NEAR(curve_at(points, x), y, 1e-13);
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (double t = 0; t <= 1; t += 0.01) {
      const double y = curve_at(points, points[i].first + t * (points[i + 1].first - points[i].first));
      EXPECT_GE(y, points[i].second - 1e-12);
      EXPECT_LE(y, points[i + 1].second + 1e-12);
    }
}

TEST(Curve, HasTheSlopesThatFritschAndButlandGive) {
  // Widths 1 and 3, secants 2 and 6: alpha = (1 + 6) / 12, d = 12 / (7/12 * 6 + 5/12 * 2) = 36 / 13.
  const Points points = {{0, 0}, {1, 2}, {4, 20}};
  const double h = 1e-6;
  EXPECT_NEAR((curve_at(points, 1 + h) - curve_at(points, 1 - h)) / (2 * h), 36.0 / 13, 1e-5);
}

TEST(Curve, GoesOnStraightButNotBelowZero) {
  const Points line = {{1, 1}, {2, 3}};
  EXPECT_DOUBLE_EQ(curve_at(line, 3), 5);
  EXPECT_DOUBLE_EQ(curve_at(line, 0.75), 0.5);
  EXPECT_DOUBLE_EQ(curve_at(line, 0), 0);
}

}  // namespace
}  // namespace genu::judge
