#include "genu/sweep/kept_numbers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

using Kind = KeepDef::Row::Kind;

ResultTable small_table() {
  ResultTable table;
  for (const char* name : {"status", "x", "y"}) table.add_column(name);
  const double rows[4][2] = {{0, 1}, {10, 3}, {20, -5}, {30, 100}};
  for (const auto& row : rows) {
    table.add_row();
    table.set("status", std::string(row[0] == 30 ? "no_equilibrium" : "ok"));
    table.set("x", row[0]);
    table.set("y", row[1]);
  }
  return table;
}

TEST(KeptValues, AreThoseOfSolvedRows) {
  MainCoordinate main;
  main.column = "x";
  main.high = 30;
  const std::vector<KeptNumber> kept = {{"y@10", "y", Kind::value, 10}, {"y@5", "y", Kind::value, 5},
                                        {"y@max", "y", Kind::max, 0},   {"y@min", "y", Kind::min, 0},
                                        {"y@last", "y", Kind::last, 0}, {"y@25", "y", Kind::value, 25},
                                        {"z@10", "z", Kind::value, 10}};
  const std::vector<double> values = kept_values(kept, main, small_table(), true);
  EXPECT_EQ(values[0], 3);
  EXPECT_EQ(values[1], 2);
  EXPECT_EQ(values[2], 3);
  EXPECT_EQ(values[3], -5);
  for (std::size_t k = 4; k < 7; ++k) EXPECT_TRUE(std::isnan(values[k])) << kept[k].name;
  const std::vector<double> part = kept_values(kept, main, small_table(), false);
  EXPECT_EQ(part[0], 3);
  EXPECT_EQ(part[1], 2);
  for (std::size_t k = 2; k < 7; ++k) EXPECT_TRUE(std::isnan(part[k])) << kept[k].name;
}

TEST(MainCoordinate, IsTheFirstThatChanges) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(test::ball_study(folder, "samples = 4\n", test::kBallVary));
  EXPECT_EQ(s.cases[0].main.column, "j.rz_deg");
  EXPECT_EQ(s.cases[0].main.rows, (std::vector<double>{0, 5, 10}));
  ASSERT_EQ(s.kept.size(), 3u);
  EXPECT_EQ(s.kept[1].name, "j.z_mm@7.5");
  EXPECT_EQ(s.kept[2].name, "j.z_mm@last");
}

TEST(MainCoordinate, HasTheRowsOfEveryStepThatMovesIt) {
  const test::TemporaryFolder folder;
  const std::string study = test::ball_study(folder, "samples = 1\n", test::kBallVary);
  folder.write("ball.toml", test::kBallOnSpring + R"([[step]]
prescribe = { "j.rz" = [10, 20] }
increments = 4
[[step]]
prescribe = { "j.rz" = [20, 0] }
increments = 1
)");
  folder.write("study.toml", test::with_first(test::read_file(study), "[0, 7.5, \"last\"]", "\"all\""));
  const Sweep s = test::ready_sweep(study);
  EXPECT_EQ(s.cases[0].main.rows, (std::vector<double>{0, 5, 10, 12.5, 15, 17.5, 20}));
  ASSERT_EQ(s.kept.size(), 7u);
  EXPECT_EQ(s.kept.back().name, "j.z_mm@20");
}

TEST(MainCoordinate, OfAMotionHasItsLastRow) {
  const test::TemporaryFolder folder;
  const std::string study = test::ball_study(folder, "samples = 1\n", test::kBallVary);
  folder.write("ball.toml", test::kBallInMotion);
  folder.write("study.toml", test::with_first(test::read_file(study), "[0, 7.5, \"last\"]", "\"all\""));
  EXPECT_EQ(test::ready_sweep(study).cases[0].main.rows, (std::vector<double>{0, 0.003, 0.004}));
}

TEST(FindKept, RefusesScenesWithOtherRows) {
  const test::TemporaryFolder folder;
  test::ball_study(folder, "", "");
  const auto said_of = [&](const char* prescribe, const char* at) {
    folder.write("other.toml", test::with_first(test::kBallOnSpring, "\"j.rz\" = [0, 10], \"j.x\" = 0", prescribe));
    const std::string study = folder.write("cohort.toml",
                                           "format = 1\nscenes = [\"ball.toml\", \"other.toml\"]\n"
                                           "samples = 2\n" +
                                               test::kBallVary + "[[keep]]\ncolumns = \"j.z\"\nat = " + at + "\n");
    Diagnostics out;
    EXPECT_FALSE(prepare_sweep(study, out));
    return test::messages(out);
  };
  std::string said = said_of("\"j.rz\" = [0, 6], \"j.x\" = 0", "\"all\"");
  EXPECT_TRUE(
      test::contains(said, ":9:6: keep.at = \"all\": means rows of the first scene, from 0 to 10, and j.rz_deg"))
      << said;
  for (const char* at : {"\"all\"", "0"}) {
    said = said_of("\"j.rz\" = 0, \"j.x\" = [0, 10]", at);
    EXPECT_TRUE(test::contains(said, ":9:6: keep.at: means j.rz_deg in the first scene and j.x_mm in")) << said;
  }
}

TEST(FindKept, RefusesColumnsAndRowsThatAreNotThere) {
  const test::TemporaryFolder folder;
  const std::string study = test::ball_study(folder, "samples = 4\n", test::kBallVary);
  folder.write("study.toml", test::read_file(study) + "[[keep]]\ncolumns = [\"j.zz\"]\nat = [11, \"all\"]\n");
  Diagnostics out;
  EXPECT_FALSE(prepare_sweep(study, out));
  const std::string said = test::messages(out);
  EXPECT_TRUE(test::contains(said, ":11:12: keep.columns = \"j.zz\": is no column of results.csv")) << said;
  EXPECT_TRUE(test::contains(said, ":12:7: keep.at = 11: j.rz_deg of")) << said;
}

}  // namespace
}  // namespace genu
