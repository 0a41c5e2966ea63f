#include "genu/results/report_data.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "genu/results/packed_numbers.h"
#include "results/report_case.h"

namespace genu {
namespace {

using Json = nlohmann::json;

TEST(ReportData, HoldsWhatThePageShows) {
  const test::ReportCase c;
  const Json run = Json::parse(report_data({c.run()}))["runs"][0];
  EXPECT_EQ(run["summary"]["verdict"][0], "1 of 2 poses are solved.");
  EXPECT_EQ(run["summary"]["version"], "1.2.3");
  EXPECT_EQ(run["rows"], 2);
  EXPECT_EQ(run["scene_text"], "format = 1\n");
  EXPECT_EQ(run["ligaments"][0]["path"][1]["point"], Json::parse("[0.0, 2.0, 0.0]"));  // mm
  EXPECT_EQ(run["bodies"][1]["centre"][0], 500.0);
  EXPECT_EQ(run["bodies"][1]["centre_of_mass"][2], 3.0);
  EXPECT_FALSE(run["bodies"][0].contains("centre_of_mass"));
  EXPECT_EQ(run["meshes"][0]["triangles"], 1);
  EXPECT_EQ(run["meshes"][0]["triangles_in_full"], 7);
  EXPECT_EQ(run["meshes"][0]["corners16"], packed(std::vector<std::uint16_t>{0, 1, 2}));
  EXPECT_EQ(run["table"][0]["words"], Json::parse(R"(["ok", "no_equilibrium"])"));
  EXPECT_EQ(run["table"][0]["places"], packed(std::vector<std::uint16_t>{0, 1}));
  EXPECT_EQ(run["table"][1]["numbers"], packed_floats({2, std::nan("")}));
}

TEST(ReportData, CurvesNameTheirColumns) {
  const test::ReportCase c;
  ReportRun r = c.run();
  r.chart.panels = {{"Translations [mm]", {{"x", {2, 3}, {}, "knee.x_mm"}, {"sum", {2, 3}}}}};
  const Json series = Json::parse(report_data({r}))["runs"][0]["chart"]["panels"][0]["series"];
  EXPECT_EQ(series[0]["column"], "knee.x_mm");
  EXPECT_FALSE(series[1].contains("column"));
}

TEST(ReportData, PosesAreToldFromNearTheJointAndMissingOnesAreNone) {
  const test::ReportCase c;
  const Json run = Json::parse(report_data({c.run()}))["runs"][0];
  EXPECT_EQ(run["origin"][0], 1e6);  // a kilometre away, where single precision knows 0.06 mm
  std::vector<double> numbers = {0, 0, 0, 1, -1e6, 0, 0, 0, 0, 0, 1, 1e3 * (1000.002 - 1000), 0, 0};
  numbers.resize(28, std::nan(""));
  EXPECT_EQ(run["poses"], packed_floats(numbers));
}

TEST(ReportData, NoTextCanLeaveItsElement) {
  test::ReportCase c;
  c.summary.title = "</script><script>alert(1)</script> & \xff \xe2\x80\xa8 <!--";
  c.model.bodies[0].name = "<img onerror=x>";
  ReportRun run = c.run();
  run.scene_text = "# ]]> </SCRIPT>";
  const std::string text = report_data({run});
  for (const char forbidden : {'<', '>', '&', '\n'}) EXPECT_EQ(text.find(forbidden), std::string::npos) << forbidden;
  const Json back = Json::parse(text);
  EXPECT_EQ(back["runs"][0]["scene_text"], "# ]]> </SCRIPT>");
  EXPECT_EQ(back["runs"][0]["bodies"][0]["name"], "<img onerror=x>");
}

TEST(ReportData, TimesStandApart) {
  test::ReportCase c;
  const std::string data = report_data({c.run()}), times = report_times({c.run()});
  EXPECT_EQ(Json::parse(times)["runs"][0]["effects"][0]["evaluations"], 21);
  EXPECT_EQ(Json::parse(times)["runs"][0]["stages"][0]["seconds"], 0.25);
  c.summary.effects[0].seconds = 7;
  c.summary.effects[0].evaluations = 22;
  c.summary.seconds[0].second = 9;
  EXPECT_EQ(report_data({c.run()}), data);
  EXPECT_NE(report_times({c.run()}), times);
}

}  // namespace
}  // namespace genu
