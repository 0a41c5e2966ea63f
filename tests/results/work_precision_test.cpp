// Which settings no other beats, and a picture that shows them.
#include "genu/results/work_precision.h"

#include <limits>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(WorkPrecision, TheFrontIsWhatNoOtherBeats) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<WorkPoint> points = {
      {"fast", "a", 1, 10},    {"exact", "a", 10, 1},       {"beaten", "a", 11, 2},    {"between", "a", 3, 3},
      {"as slow", "a", 10, 2}, {"no time", "a", nan, 1e-9}, {"no error", "a", 0.1, 0}, {"same", "b", 3, 3}};
  EXPECT_EQ(pareto_front(points), (std::vector<bool>{true, true, false, true, false, false, false, true}));
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(WorkPrecision, ThePictureHoldsEveryPointThatHasBoth) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string svg =
      to_svg("a <knee>", {{"position [mm]", {{"edge 1 mm", "mesh", 1e-5, 1e-3}, {"failed", "mesh", nan, 1}}, 0.01},
                          {"nothing [N]", {{"exact", "mesh", 1e-5, 0}}, 0}});
  EXPECT_NE(svg.find("a &lt;knee&gt;"), std::string::npos);
  EXPECT_NE(svg.find("<title>edge 1 mm</title>"), std::string::npos);
  EXPECT_EQ(svg.find("failed"), std::string::npos);
  EXPECT_NE(svg.find("class=\"target\" d"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace genu
