#include "genu/results/svg_axes.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "support/text.h"

namespace genu {
namespace {

TEST(SvgAxes, TicksAreRoundAndCoverTheRange) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> exponent(-2, 6), unit(-1, 1);
  for (int k = 0; k < 2000; ++k) {
    const double width = std::pow(10, exponent(generator)), low = 10 * width * unit(generator), high = low + width;
    const auto ticks = round_ticks(low, high, 5);
    ASSERT_GE(ticks.size(), 3u);
    ASSERT_LE(ticks.size(), 11u) << low << " " << high;
    const double step = ticks[1] - ticks[0], mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
    EXPECT_LT(std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 5)}), 1e-6) << step;
    EXPECT_LE(ticks.front(), low + 1e-6 * step);
    EXPECT_GE(ticks.back(), high - 1e-6 * step);
  }
}

TEST(SvgAxes, AConstantOrNothingStillHasAnAxis) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const auto& [low, high] : {std::pair{20.0, 20.0}, {0.0, 0.0}, {inf, -inf}, {-1e9, -1e9}, {20.0, 20.0 + 1e-14}}) {
    const auto ticks = round_ticks(low, high, 5);
    EXPECT_GE(ticks.size(), 2u) << low;
    EXPECT_LT(ticks.size(), 12u) << low;
    EXPECT_LT(ticks.front(), ticks.back()) << low;
  }
}

std::string plain(double value) { return "v" + std::to_string(static_cast<int>(std::lround(value))); }

TEST(SvgAxes, MapsItsEndsToTheirPixels) {
  const SvgAxis line = linear_axis(-1, 9, 5, {200, 50}), log = log_axis(1, 100, {10, 110}, plain, 0);
  EXPECT_DOUBLE_EQ(line(line.low), 200);
  EXPECT_DOUBLE_EQ(line(line.high), 50);
  EXPECT_DOUBLE_EQ(log(1), 10);
  EXPECT_DOUBLE_EQ(log(10), 60);
  EXPECT_DOUBLE_EQ(log(100), 110);
}

TEST(SvgAxes, AnAxisWithinEndsWhereTheDataEnds) {
  const SvgAxis axis = linear_axis_within(3, 47, 8, {0, 100});
  EXPECT_EQ(axis.low, 3);
  EXPECT_EQ(axis.high, 47);
  EXPECT_EQ(axis.ticks.front().label, "5");
  EXPECT_EQ(axis.ticks.back().label, "45");
  EXPECT_LT(linear_axis_within(2, 2, 8, {0, 100}).low, 2) << "one value has an axis too";
}

TEST(SvgAxes, DecadesAreDividedWhereThereAreFew) {
  EXPECT_EQ(decade_ticks(1, 10), (std::vector<double>{1, 2, 5, 10}));
  EXPECT_EQ(decade_ticks(3, 4), (std::vector<double>{2, 5}));
  EXPECT_EQ(decade_ticks(2, 3000), (std::vector<double>{1, 10, 100, 1000, 10000}));
}

TEST(SvgAxes, LabelsKeepTheirDistanceAndAFiveGivesWayToATen) {
  const SvgAxis axis = log_axis(1, 100, {0, 100}, plain, 20);
  std::string labels;
  for (const SvgAxis::Tick& t : axis.ticks) labels += t.label + "|";
  EXPECT_EQ(labels, "v1|||v10|||v100|") << "2 is 15 pixels from 1, 5 is 15 from 10";
  std::size_t all = 0;
  for (const SvgAxis::Tick& t : log_axis(1, 100, {0, 1000}, plain, 20).ticks) all += t.label.empty() ? 0 : 1;
  EXPECT_EQ(all, axis.ticks.size());
}

TEST(SvgAxes, DrawsALineAndANumberForEachTick) {
  const SvgAxis x = log_axis(1, 1000, {60, 360}, plain, 20), y = linear_axis(-2, 2, 4, {200, 20});
  const std::string svg = draw_axes(x, y, "time <s>");
  EXPECT_EQ(test::occurrences(svg, "class=\"grid\""), 4 + 4) << "all of x, all of y but 0";
  EXPECT_EQ(test::occurrences(svg, "class=\"zero\""), 1);
  EXPECT_EQ(test::occurrences(svg, "class=\"axis\""), 4 + 1);
  EXPECT_EQ(test::occurrences(svg, ">v100<") + test::occurrences(svg, ">-2<"), 2);
  EXPECT_EQ(test::occurrences(svg, "time &lt;s&gt;"), 1);
}

}  // namespace
}  // namespace genu
