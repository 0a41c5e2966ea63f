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
      to_svg({"a <knee>",
              {{"position [mm]", {{"edge 1 mm", "mesh", 1e-5, 1e-3}, {"failed", "mesh", nan, 1}}, 0.01},
               {"nothing [N]", {{"exact", "mesh", 1e-5, 0}}, 0}},
              {"words & more"},
              {}});
  EXPECT_NE(svg.find("words &amp; more"), std::string::npos);
  EXPECT_NE(svg.find("a &lt;knee&gt;"), std::string::npos);
  EXPECT_NE(svg.find("<title>edge 1 mm</title>"), std::string::npos);
  EXPECT_EQ(svg.find("failed"), std::string::npos);
  EXPECT_NE(svg.find("class=\"target\" d"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t n = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++n;
  return n;
}

TEST(WorkPrecision, WhatIsChosenHasARingInEveryPanel) {
  WorkPanel panel{"a", {{"one", "mesh", 1e-5, 1e-3}, {"two", "mesh", 2e-5, 1e-4, true}}, 0};
  EXPECT_EQ(count(to_svg({"", {panel, panel}, {}, {}}), "class=\"chosen\""), 2u);
  panel.points[1].chosen = false;
  EXPECT_EQ(count(to_svg({"", {panel, panel}, {}, {}}), "class=\"chosen\""), 0u);
}

TEST(WorkPrecision, ASeriesHasItsColourWhicheverOthersThereAre) {
  const std::vector<std::string> order = {"as it is", "mesh", "tolerance"};
  const WorkPanel both{"a", {{"p", "mesh", 1e-5, 1e-3}, {"q", "tolerance", 1e-5, 1e-3}}, 0},
      one{"a", {{"q", "tolerance", 1e-5, 1e-3}}, 0};
  const std::string two = to_svg({"", {both}, {}, order}), single = to_svg({"", {one}, {}, order});
  const std::string third = "fill=\"#4292c6\"";
  EXPECT_EQ(count(two, third), 2u) << "the point and the legend";
  EXPECT_EQ(count(single, third), 2u);
  EXPECT_EQ(count(single, ">as it is<") + count(single, ">mesh<"), 0u) << "what is not drawn is not explained";
}

/// Few decades are divided at 2 and 5, and no line stands far from all points.
TEST(WorkPrecision, AxesReachAroundThePoints) {
  const std::string few = to_svg({"", {{"a", {{"p", "s", 6e-5, 0.3}, {"q", "s", 1.5e-4, 4}}, 0}}, {}, {}});
  for (const char* label : {">50 us<", ">100 us<", ">200 us<", ">2e-1<", ">5e-1<", ">1e0<", ">5e0<"})
    EXPECT_EQ(count(few, label), 1u) << label;
  for (const char* label : {">20 us<", ">500 us<", ">1e-1<", ">1e1<"}) EXPECT_EQ(count(few, label), 0u) << label;
  const std::string three = to_svg({"", {{"a", {{"p", "s", 9e-4, 1e-1}, {"q", "s", 1.4e-2, 1e-1}}, 0}}, {}, {}});
  EXPECT_EQ(count(three, ">500 us<") + count(three, ">20 ms<"), 2u) << "in three decades, but not over them";
  const std::string many = to_svg({"", {{"a", {{"p", "s", 6e-7, 1e-9}, {"q", "s", 1.5e-1, 4}}, 0}}, {}, {}});
  for (const char* label : {">100 ns<", ">10 us<", ">1 ms<", ">100 ms<", ">1e-9<", ">1e1<"})
    EXPECT_EQ(count(many, label), 1u) << label;
  for (const char* label : {">2e-1<", ">1 us<"}) EXPECT_EQ(count(many, label), 0u) << label;
}

}  // namespace
}  // namespace genu
