#include "genu/results/chart.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "support/text.h"

namespace genu {
namespace {

TEST(Chart, TicksAreRoundAndCoverTheRange) {
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

TEST(Chart, AConstantOrNothingStillHasAnAxis) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const auto& [low, high] : {std::pair{20.0, 20.0}, {0.0, 0.0}, {inf, -inf}, {-1e9, -1e9}, {20.0, 20.0 + 1e-14}}) {
    const auto ticks = round_ticks(low, high, 5);
    EXPECT_GE(ticks.size(), 2u) << low;
    EXPECT_LT(ticks.size(), 12u) << low;
    EXPECT_LT(ticks.front(), ticks.back()) << low;
  }
}

TEST(Chart, NeverWritesWhatIsNoNumberAndEscapesWords) {
  const double nan = std::nan("");
  Chart chart{"a<b & \"c\"\x01", "x", {0, 1, 2, 3}, {}, {}};
  chart.panels.push_back({"gaps", {{"one", {1, nan, 2, nan}}, {"none", {nan, nan, nan, nan}}}, false, true});
  chart.panels.push_back({"empty", {}, true, true});
  chart.events.push_back({ChartEvent::Kind::other, nan, nan, "nowhere"});
  const std::string svg = to_svg(chart);
  EXPECT_EQ(test::occurrences(svg, "nan"), 0) << svg;
  EXPECT_EQ(test::occurrences(svg, "inf"), 0) << svg;
  EXPECT_EQ(test::occurrences(svg, "a&lt;b &amp; &quot;c&quot;<"), 1);
  EXPECT_EQ(test::occurrences(svg, "<circle"), 2);  // two values alone between gaps
  EXPECT_EQ(svg, to_svg(chart));
}

TEST(Chart, MarksEventsInEveryPanelAndWhereTheFirstLineCrossesZero) {
  Chart chart{"t", "x", {0, 1, 2}, {}, {}};
  chart.panels.push_back({"eigenvalue", {{"e", {3, 1, -1}}}, true, true});
  chart.panels.push_back({"other", {{"o", {3, 1, -1}}}, true, false});
  chart.events.push_back({ChartEvent::Kind::gained, 0.5, 0.5, "gained"});
  chart.events.push_back({ChartEvent::Kind::window, 1, 1.5, "stepped over"});
  const std::string svg = to_svg(chart);
  EXPECT_EQ(test::occurrences(svg, "class=\"crossing\""), 1);
  EXPECT_EQ(test::occurrences(svg, ">0 at 1.5<"), 1);
  EXPECT_EQ(test::occurrences(svg, "class=\"event\""), 2);
  EXPECT_EQ(test::occurrences(svg, "class=\"window\""), 3);  // two panels and the list below
}

}  // namespace
}  // namespace genu
