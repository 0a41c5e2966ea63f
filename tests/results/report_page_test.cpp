#include "genu/results/report_page.h"

#include <gtest/gtest.h>

#include "genu/results/report_template.h"
#include "support/text.h"

namespace genu {
namespace {

TEST(ReportPage, IsFilledWithTitleDataAndTimes) {
  const std::string page = report_page("a < b", "{\"d\": 1}", "{\"t\": 2}");
  EXPECT_TRUE(test::contains(page, "<title>a &lt; b</title>"));
  EXPECT_TRUE(test::contains(page, "id=\"genu-data\">{\"d\": 1}</script>"));
  EXPECT_TRUE(test::contains(page, "id=\"genu-times\">\n{\"t\": 2}\n</script>"));
}

TEST(ReportPage, ShowsPicturesAsImagesAndTheirWordsAsText) {
  const std::string page = report_page("t", "{}", "{}", {{"a & b", "<svg/>", "x < y\n  z"}});
  EXPECT_TRUE(test::contains(page, "<h2>a &amp; b</h2>"));
  EXPECT_TRUE(test::contains(page, "src=\"data:image/svg+xml;base64,PHN2Zy8+\""));
  EXPECT_TRUE(test::contains(page, "<pre>x &lt; y\n  z\n</pre>"));
}

TEST(ReportPage, JsonKeepsItsMeaningAndLosesItsMarkup) {
  EXPECT_EQ(html_safe_json(R"({"a": "</script>&"})"), R"({"a": "\u003c/script\u003e\u0026"})");
  EXPECT_EQ(html_safe_json(""), "");
}

TEST(ReportPage, AwaitsTitleDataAndTimesOnceEach) {
  std::string order;
  for (const ReportTemplatePart& part : report_template())
    if (!part.then.empty()) order += std::string(part.then) + " ";
  EXPECT_EQ(order, "title more data times ");
}

}  // namespace
}  // namespace genu
