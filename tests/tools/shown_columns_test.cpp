#include "cli/shown_columns.h"

#include <algorithm>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace genu::cli {
namespace {

using Names = std::vector<std::string>;

/// One row: a ball on a plate with five prescribed coordinates, of which one needs a force.
ResultTable ball_on_plate() {
  ResultTable table;
  const std::pair<const char*, double> row[] = {
      {"j.rx_deg", 0},         {"j.ry_deg", 0},          {"j.rz_deg", 0},           {"j.x_mm", 1},
      {"j.y_mm", 0},           {"j.z_mm", 19.6},         {"j.rx.reaction_Nm", 0},   {"j.ry.reaction_Nm", 3e-5},
      {"j.rz.reaction_Nm", 0}, {"j.x.reaction_N", -0.2}, {"j.y.reaction_N", 1e-12}, {"c.force_N", 60},
      {"c.gap_mm", 0},         {"c.a.force_N", 30},      {"c.a.points", 1},         {"c.1.force_N", 60},
      {"c.1.gap_mm", 0},       {"mcl.force_N", 5},       {"mcl.length_mm", 90},     {"c.a.mean_pressure_MPa", 1}};
  table.add_column("status");
  for (const auto& [name, value] : row) table.add_column(name);
  table.add_column("stability");
  table.add_row();
  for (const auto& [name, value] : row) table.set(name, value);
  return table;
}

TEST(ShownColumns, ForcesOfContactsComeBeforeReactions) {
  EXPECT_EQ(columns_of_run(ball_on_plate()),
            (Names{"j.rx_deg", "j.ry_deg", "j.rz_deg", "j.x_mm", "j.y_mm", "j.z_mm", "j.x.reaction_N", "c.force_N",
                   "c.a.force_N", "stability", "status"}));
}

TEST(ShownColumns, ReactionsThatAreZeroToTheDecimalsShownAreLeftOut) {
  ResultTable table = ball_on_plate();
  table.set("j.ry.reaction_Nm", 6e-5);
  const Names shown = columns_of_run(table);
  EXPECT_EQ(std::count(shown.begin(), shown.end(), "j.ry.reaction_Nm"), 1);
  EXPECT_EQ(std::count(shown.begin(), shown.end(), "j.rx.reaction_Nm"), 0);
}

TEST(ShownColumns, OneRowThatIsNotZeroIsEnough) {
  ResultTable table = ball_on_plate();
  table.add_row();
  table.set("j.rx.reaction_Nm", -2.0);
  const Names shown = columns_of_run(table);
  EXPECT_EQ(std::count(shown.begin(), shown.end(), "j.rx.reaction_Nm"), 1);
}

}  // namespace
}  // namespace genu::cli
