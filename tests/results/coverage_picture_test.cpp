#include "genu/results/coverage_picture.h"

#include <gtest/gtest.h>

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

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(CoveragePicture, DrawsCellsPatchAndContacts) {
  const std::string svg = coverage_svg({map(), map(), map()});
  EXPECT_EQ(svg, coverage_svg({map(), map(), map()}));
  EXPECT_EQ(count(svg, "class=\"p\""), 3u);
  EXPECT_EQ(count(svg, "<circle"), 3u);
  EXPECT_EQ(count(svg, "#cccccc"), 15u);  // no distance: off the patch
  EXPECT_EQ(count(svg, "femur &lt;1&gt;"), 3u);
  EXPECT_NE(svg.find("mesh 0.1 mm below"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(coverage_svg({}).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace genu
