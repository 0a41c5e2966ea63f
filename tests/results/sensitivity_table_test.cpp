#include "genu/results/sensitivity_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "support/scene_model.h"

namespace genu {
namespace {

/// Two outputs, three parameters, three rows; the last row has no derivatives.
struct Sample {
  PlacedScene scene = test::scene_model(test::bone_on_ground() + test::step("prescribe = { \"j.z\" = [0, 2] }")).scene;
  std::vector<StepPlan> steps{1};
  ResultTable poses;
  SensitivityRows rows;

  Sample() {
    steps[0].prescribed.push_back({QuantityRef(0, 5), 0, 2e-3});
    for (const char* name : {"step", "increment", "j.z_mm"}) poses.add_column(name);
    for (int k = 0; k < 3; ++k) {
      poses.add_row();
      poses.set("step", 1L);
      poses.set("increment", static_cast<long>(k));
      poses.set("j.z_mm", 1.0 * k);
    }
    rows.outputs = {{"l.force_N", "N", 1, {}, 0}, {"l.strain", "1", 1, {}, 0}};
    for (const char* name : {"weak", "strong", "none"}) {
      Parameter p;
      p.name = name;
      p.unit = "mm";
      p.si = 1e-3;
      p.change = 2e-3;
      p.change_text = "2 mm";
      rows.parameters.push_back(p);
    }
    rows.derivatives = {1, -3, 0, 0.1, 0.2, 0, 2, 4, 0, 0.1, -0.5, 0, NAN, NAN, NAN, NAN, NAN, NAN};
  }
};

TEST(SensitivityTable, RanksByTheLargestEffectAlongThePath) {
  const Sample s;
  ASSERT_EQ(s.rows.rows(), 3u);
  const auto force = ranking(s.rows, 0);
  ASSERT_EQ(force.size(), 2u);  // one parameter does nothing
  EXPECT_EQ(force[0].parameter, 1u);
  EXPECT_EQ(force[0].row, 1u);
  EXPECT_DOUBLE_EQ(force[0].largest, 8);  // 4 N/mm, 2 mm
  EXPECT_DOUBLE_EQ(force[0].mean_size, std::sqrt((36 + 64) / 2.0));
  EXPECT_DOUBLE_EQ(ranking(s.rows, 1)[0].largest, -1);
  const ResultTable table = ranking_table(s.rows, s.scene, s.steps, s.poses);
  EXPECT_EQ(table.rows(), 4u);
  EXPECT_EQ(table.number(0, "j.z_mm"), 1);
  const std::string text = ranking_text(s.rows, s.scene, s.steps, s.poses, 1);
  EXPECT_NE(text.find("strong"), std::string::npos);
  EXPECT_NE(text.find("at j.z_mm = 1"), std::string::npos);
  EXPECT_NE(text.find("and 1 more"), std::string::npos);
  EXPECT_EQ(text.find("weak"), std::string::npos);
}

TEST(SensitivityTable, ParametersThatDoTheSameShareARank) {
  Sample s;
  s.rows.parameters[2].name = "twin";
  s.rows.derivatives = {1, -3, -3, 0.1, 0.2, 0.2, 2, 4, 4, 0.1, -0.5, 0.5, NAN, NAN, NAN, NAN, NAN, NAN};
  const auto force = ranking(s.rows, 0);
  ASSERT_EQ(force.size(), 2u);
  EXPECT_EQ(force[0].alike, std::vector<std::size_t>{2});
  EXPECT_EQ(ranking(s.rows, 1).size(), 3u) << "of opposite signs at one pose: not the same";
  const ResultTable table = ranking_table(s.rows, s.scene, s.steps, s.poses);
  ASSERT_EQ(table.rows(), 6u);
  EXPECT_EQ(table.number(0, "rank"), 1);
  EXPECT_EQ(table.number(1, "rank"), 1);
  EXPECT_EQ(table.number(2, "rank"), 2);
  EXPECT_NE(ranking_text(s.rows, s.scene, s.steps, s.poses, 1).find("and so does twin"), std::string::npos);
  EXPECT_EQ(sensitivity_chart(s.rows, {}).panels[0].series[0].name, "strong (and 1 alike)");
}

TEST(SensitivityTable, HasARowForEachPoseOutputAndParameter) {
  const Sample s;
  const std::string csv = sensitivity_csv(s.rows, s.scene, s.steps, s.poses);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 2 * 3);
  EXPECT_EQ(csv.rfind("step,increment,j.z_mm,output,parameter,derivative,unit,change,effect\n", 0), 0u);
  EXPECT_NE(csv.find("\n1,1,1,l.force_N,strong,4,N per mm,2 mm,8\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n1,2,2,l.strain,strong,,1 per mm,2 mm,\n"), std::string::npos) << csv;
}

TEST(SensitivityTable, DrawsTheMostImportantParameters) {
  const Sample s;
  Chart axis;
  axis.title = "knee";
  axis.x = {0, 1, 2};
  const Chart chart = sensitivity_chart(s.rows, axis);
  ASSERT_EQ(chart.panels.size(), 2u);
  EXPECT_EQ(chart.panels[0].title, "l.force [N]");
  EXPECT_EQ(chart.panels[1].title, "l.strain [1/1000]");
  EXPECT_EQ(chart.panels[1].series[0].y[1], -1000);
  EXPECT_EQ(chart.panels[0].series[0].name, "strong");
  EXPECT_EQ(chart.panels[0].series[0].y[1], 8);
  EXPECT_TRUE(std::isnan(chart.panels[0].series[0].y[2]));
}

TEST(SensitivityTable, ColumnsStandUnderEachOther) {
  Sample s;
  s.rows.parameters[0].name = "a_parameter_with_a_long_name";
  s.rows.parameters[0].change_text = "0.0123456789 mm";
  s.rows.derivatives[0] = -1234.56;
  const std::string text = ranking_text(s.rows, s.scene, s.steps, s.poses, 9);
  std::istringstream lines(text);
  std::map<std::size_t, int> rms, at;
  int ranked = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("(rms ") == std::string::npos) {
      EXPECT_LE(rms.size(), 1u) << text;
      EXPECT_LE(at.size(), 1u) << text;
      rms.clear();
      at.clear();
      continue;
    }
    ++rms[line.find("(rms ")];
    ++at[line.find("at j.z_mm")];
    ++ranked;
  }
  EXPECT_GE(ranked, 4) << text;
}

}  // namespace
}  // namespace genu
