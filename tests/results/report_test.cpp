#include "genu/results/report.h"

#include <gtest/gtest.h>

#include "results/report_case.h"
#include "support/text.h"

namespace genu {
namespace {

using test::contains;
using test::occurrences;

TEST(Report, IsOnePageThatNeedsNothingElse) {
  const test::ReportCase c;
  const std::string page = report_html({c.run()});
  EXPECT_EQ(page.rfind("<!doctype html>", 0), 0u);
  EXPECT_TRUE(contains(page, "<title>knee</title>"));
  EXPECT_TRUE(contains(page, "</html>"));
  EXPECT_TRUE(contains(page, "default-src 'none'"));  // the browser itself forbids every request
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "{{genu-"})
    EXPECT_FALSE(contains(page, outside)) << outside;
  EXPECT_TRUE(contains(page, "Permission is hereby granted"));  // the licences of what it holds
  EXPECT_EQ(page, report_html({c.run()}));
}

TEST(Report, ATitleIsTextWhateverItSays) {
  test::ReportCase c;
  const std::string before = report_html({c.run()});
  c.summary.title = "</title></script><script>alert(1)</script>";
  const std::string page = report_html({c.run()});
  EXPECT_EQ(occurrences(page, "<script"), occurrences(before, "<script"));
  EXPECT_EQ(occurrences(page, "</script"), occurrences(before, "</script"));
  EXPECT_FALSE(contains(page, "<script>alert"));
  c.summary.title.clear();
  EXPECT_TRUE(contains(report_html({c.run()}), "<title>dir/knee.toml</title>"));
}

TEST(Report, OnlyTheLineOfTimesDependsOnThem) {
  test::ReportCase c;
  const std::string before = report_html({c.run()});
  c.summary.seconds[0].second = 77;
  const std::string after = report_html({c.run()});
  ASSERT_NE(before, after);
  const std::string mark = "id=\"genu-times\">\n";
  const auto without = [&](const std::string& page) {
    const std::size_t from = page.find(mark) + mark.size();
    return page.substr(0, from) + page.substr(page.find('\n', from));
  };
  EXPECT_EQ(without(before), without(after));
}

}  // namespace
}  // namespace genu
