// The monotone interpolant against its definition, its own derivatives and points it must pass through.
#include "genu/law/monotone_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace genu {
namespace {

using Points = std::vector<std::pair<double, double>>;

MonotoneTable table(const Points& points) {
  std::string why;
  auto t = MonotoneTable::make(points, why);
  EXPECT_TRUE(t) << why;
  return *t;
}

Points random_rising(std::mt19937& generator, int n) {
  std::uniform_real_distribution<double> step(0.01, 1);
  Points points{{-0.3, 0}};
  for (int i = 1; i < n; ++i)
    points.emplace_back(points.back().first + step(generator),
                        points.back().second + (i % 4 == 2 ? 0 : 100 * std::pow(step(generator), 3)));
  return points;
}

TEST(MonotoneTable, GoesThroughItsPoints) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Points points = random_rising(generator, 8);
    const MonotoneTable t = table(points);
    for (const auto& [x, y] : points) EXPECT_NEAR(t.evaluate(x).y, y, 1e-13 * (1 + y));
  }
}

TEST(MonotoneTable, NeverFallsWherePointsRise) {
  std::mt19937 generator(2);
  double steepest_fall = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Points points = random_rising(generator, 8);
    const MonotoneTable t = table(points);
    const double first = points.front().first - 0.5, last = points.back().first + 0.5;
    for (int i = 0; i <= 1000; ++i)
      steepest_fall = std::min(steepest_fall, t.evaluate(first + (last - first) * i / 1000).slope);
  }
  EXPECT_GE(steepest_fall, -1e-10);
}

/// Widths 1 and 3, secants 2 and 6: alpha = (h1 + 2 h2) / (3 (h1 + h2)) = 7/12 goes with the left one, so that the
/// slope is 2 * 6 / (7/12 * 6 + 5/12 * 2) = 36/13 (Fritsch and Butland 1984, (6) and (7); PCHIM of SLATEC).
TEST(MonotoneTable, WeighsUnequalIntervalsAsThePaperDoes) {
  EXPECT_NEAR(table({{0, 0}, {1, 2}, {4, 20}}).evaluate(1).slope, 36.0 / 13, 1e-14);
  EXPECT_NEAR(table({{0, 0}, {3, 6}, {4, 12}}).evaluate(3).slope, 12.0 / (5.0 / 12 * 6 + 7.0 / 12 * 2), 1e-14);
}

TEST(MonotoneTable, SlopeAndIntegralAreTheCurves) {
  std::mt19937 generator(3);
  double worst_slope = 0, worst_integral = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Points points = random_rising(generator, 6);
    const MonotoneTable t = table(points);
    for (double x = points.front().first - 0.2; x < points.back().first + 0.2; x += 0.0173) {
      const double h = 1e-5;
      const auto v = t.evaluate(x), up = t.evaluate(x + h), down = t.evaluate(x - h);
      const bool kink = std::abs(x - points.front().first) < h;
      if (!kink) worst_slope = std::max(worst_slope, std::abs((up.y - down.y) / (2 * h) - v.slope) / 100);
      worst_integral = std::max(worst_integral, std::abs((up.integral - down.integral) / (2 * h) - v.y) / 100);
    }
  }
  EXPECT_LT(worst_slope, 1e-2);  // the second derivative jumps at the points: first-order differences there
  EXPECT_LT(worst_integral, 1e-7);
}

// Slopes worked out by hand: secants 1, 3 with steps 1, 1 give 6 / (3/1 + 3/3) = 3/2 inside and
// (3 * 1 - 3) / 2 = 0, (3 * 3 - 1) / 2 = 4 at the ends.
TEST(MonotoneTable, HasTheTextbookSlopes) {
  const MonotoneTable t = table({{0, 0}, {1, 1}, {2, 4}});
  EXPECT_NEAR(t.evaluate(0).slope, 0, 1e-15);
  EXPECT_NEAR(t.evaluate(1).slope, 1.5, 1e-15);
  EXPECT_NEAR(t.evaluate(2).slope, 4, 1e-15);
  EXPECT_NEAR(t.evaluate(0.5).y, 0.5 - 1.5 / 8, 1e-15);
}

TEST(MonotoneTable, GoesOnStraightOutside) {
  const MonotoneTable t = table({{-1, -3}, {0, 0}, {1, 1}, {2, 4}});
  EXPECT_NEAR(t.evaluate(3).y, 4 + t.evaluate(2).slope, 1e-14);
  EXPECT_NEAR(t.evaluate(-2).y, -3 - t.evaluate(-1).slope, 1e-14);
  EXPECT_FALSE(t.zero_until());
}

TEST(MonotoneTable, WithoutNegativeValuesStopsAtZero) {
  const MonotoneTable rising = table({{0.1, 2}, {0.2, 4}});
  EXPECT_NEAR(rising.evaluate(0.05).y, 1, 1e-15);
  EXPECT_NEAR(*rising.zero_until(), 0, 1e-16);
  EXPECT_EQ(rising.evaluate(-0.01).y, 0);
  EXPECT_EQ(rising.evaluate(-0.01).slope, 0);
  EXPECT_NEAR(rising.evaluate(-5).integral, -0.1, 1e-15);  // the triangle under the extension
  const MonotoneTable torn = table({{0, 0}, {1, 4}, {2, 2}});
  EXPECT_EQ(torn.evaluate(50).y, 0);
  EXPECT_EQ(*table({{-1, 0}, {0, 0}, {0.5, 0}, {1, 1}}).zero_until(), 0.5);
}

TEST(MonotoneTable, SolvesForTheFirstRise) {
  std::mt19937 generator(4);
  double worst = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Points points = random_rising(generator, 7);
    const MonotoneTable t = table(points);
    for (double fraction : {1e-9, 0.1, 0.37, 0.9, 0.999, 1.0, 1.2}) {
      const double y = fraction * points.back().second;
      const auto x = t.first_rise_through(y);
      if (!x) {
        EXPECT_GT(fraction, 1) << "a value between the points has a solution";
        continue;
      }
      const auto v = t.evaluate(*x);
      const double ulp = std::numeric_limits<double>::epsilon() * (std::abs(v.slope * *x) + y);  // of x and y
      worst = std::max(worst, std::abs(v.y - y) / ulp);
    }
  }
  EXPECT_LT(worst, 8) << "rounding errors";
  EXPECT_EQ(*table({{-1, 0}, {0, 0}, {1, 1}}).first_rise_through(0), 0);
  EXPECT_FALSE(table({{0, 0}, {1, 1}}).first_rise_through(-1));
  EXPECT_FALSE(table({{0, 0}, {1, 1}, {2, 1}}).first_rise_through(1.5));
  EXPECT_EQ(*table({{0, 0}, {1, 1}, {2, 1}}).first_rise_through(1), 2);
}

TEST(MonotoneTable, RefusesWhatIsNoCurve) {
  std::string why;
  EXPECT_FALSE(MonotoneTable::make({}, why));
  EXPECT_FALSE(MonotoneTable::make({{0, 1}}, why));
  EXPECT_FALSE(MonotoneTable::make({{0, 1}, {0, 2}}, why));
  EXPECT_NE(why.find("increase"), std::string::npos);
  EXPECT_FALSE(MonotoneTable::make({{0, 1}, {1, std::numeric_limits<double>::infinity()}}, why));
  EXPECT_NE(why.find("finite"), std::string::npos);
}

}  // namespace
}  // namespace genu
