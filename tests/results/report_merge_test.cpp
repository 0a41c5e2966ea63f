#include "genu/results/report_merge.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "genu/results/report_page.h"
#include "results/report_case.h"
#include "support/text.h"

namespace genu {
namespace {

nlohmann::json data_of(const std::string& page) {
  const std::string mark = "id=\"genu-data\">";
  const std::size_t from = page.find(mark) + mark.size();
  return nlohmann::json::parse(page.substr(from, page.find('<', from) - from));
}

TEST(ReportMerge, PutsAllRunsInOrderUnderTheirNames) {
  test::ReportCase a, b;
  b.summary.title = "other <knee>";
  const std::string one = report_html({a.run()}), two = report_html({b.run()});
  const std::string both = merged_report({{"rigid", one}, {"a<b", two}});
  const auto runs = data_of(both)["runs"];
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0]["name"], "rigid");
  EXPECT_EQ(runs[1]["name"], "a<b");
  EXPECT_EQ(runs[1]["summary"]["title"], "other <knee>");
  EXPECT_EQ(runs[0]["poses"], data_of(one)["runs"][0]["poses"]);
  EXPECT_TRUE(test::contains(both, "<title>rigid and a&lt;b</title>"));
  EXPECT_EQ(test::occurrences(both, "<script"), test::occurrences(one, "<script"));
  const auto three = data_of(merged_report({{"x", both}, {"y", one}}))["runs"];
  ASSERT_EQ(three.size(), 3u);
  EXPECT_EQ(three[1]["name"], "x: a<b");
  EXPECT_EQ(three[2]["name"], "y");
}

TEST(ReportMerge, WhatIsNoReportIsTold) {
  const test::ReportCase c;
  const std::string page = report_html({c.run()});
  EXPECT_EQ(why_no_report(page), "");
  EXPECT_EQ(why_no_report(page + "\n"), "");
  EXPECT_TRUE(test::contains(why_no_report(page.substr(0, page.size() - 200)), "is cut"));
  for (const char* text : {"", "<html></html>", "id=\"genu-data\">", " id=\"genu-data\">{}< id=\"genu-times\">{}<",
                           " id=\"genu-data\">{\"runs\": [}<",
                           " id=\"genu-data\">{\"format\": 2, \"runs\": [7]}< id=\"genu-times\">{\"runs\": [0]}<"})
    EXPECT_EQ(why_no_report(text), "is no report.html of genu") << text;
  const std::string later = report_page("t", R"({"format": 3, "runs": [{}]})", R"({"runs": [{}]})");
  EXPECT_TRUE(test::contains(why_no_report(later), "another version"));
}

}  // namespace
}  // namespace genu
