#include "genu/results/chart.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/text.h"

namespace genu {
namespace {

TEST(Chart, NeverWritesWhatIsNoNumberAndEscapesWords) {
  const double nan = std::nan("");
  Chart chart{"a<b & \"c\"\x01", "x", {0, 1, 2, 3}, {}, {}, {}};
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
  Chart chart{"t", "x", {0, 1, 2}, {}, {}, {}};
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
