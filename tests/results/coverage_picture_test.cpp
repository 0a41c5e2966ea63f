#include "genu/results/coverage_picture.h"

#include <gtest/gtest.h>

#include "support/text.h"

namespace genu {
namespace {

CoverageMap map() {
  CoverageMap m;
  m.title = "femur <1>";
  m.low = Vec2(-2, -1);
  m.high = Vec2(2, 1);
  for (int k = 0; k < 10; ++k)
    m.samples.push_back({Vec2(3 * k - 15, 0.1), k < 5 ? std::optional(0.02 * k) : std::nullopt});
  m.contacts = {Vec2(0, 0)};
  return m;
}

TEST(CoveragePicture, DrawsCellsPatchAndContacts) {
  const std::string svg = coverage_svg({map(), map(), map()});
  EXPECT_EQ(svg, coverage_svg({map(), map(), map()}));
  EXPECT_EQ(test::occurrences(svg, "class=\"p\""), 3);
  EXPECT_EQ(test::occurrences(svg, "<circle"), 3);
  EXPECT_EQ(test::occurrences(svg, "#cccccc"), 15);  // no distance: off the patch
  EXPECT_EQ(test::occurrences(svg, "femur &lt;1&gt;"), 3);
  EXPECT_NE(svg.find("mesh 0.1 mm below"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(coverage_svg({}).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace genu
