#include "genu/results/svg_text.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(SvgText, EscapesWhatXmlReservesAndDropsControlCharacters) {
  EXPECT_EQ(svg_escaped("a<b & \"c\" > d\x07"), "a&lt;b &amp; &quot;c&quot; &gt; d");
}

TEST(SvgText, WritesWordsAndLinesInPixels) {
  EXPECT_EQ(svg_text(1, 2.25, "F < 3", "class=\"tick\""), "<text x=\"1.0\" y=\"2.2\" class=\"tick\">F &lt; 3</text>\n");
  EXPECT_EQ(svg_text(1, 2, "x"), "<text x=\"1.0\" y=\"2.0\">x</text>\n");
  EXPECT_EQ(svg_line(0, 1, 2, 3, "grid"), "<path class=\"grid\" d=\"M0.0 1.0L2.0 3.0\"/>\n");
  EXPECT_EQ(svg_opening(10, 20, "s{}").rfind("<svg xmlns=", 0), 0u);
}

}  // namespace
}  // namespace genu
