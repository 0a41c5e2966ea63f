// A run's folder read again holds what the run had.
#include "genu/store/read_results.h"

#include <gtest/gtest.h>

#include "genu/store/report.h"
#include "genu/study/evaluate.h"
#include "support/scenes.h"
#include "tools/cli_scenes.h"

namespace genu {
namespace {

TEST(ReadResults, HoldsThePosesContactsAndForcesOfTheRun) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  Solution solution;
  ASSERT_EQ(run_scene(test::dortmans_file(), folder / "run", {}, out, &solution), kExitOk) << test::messages(out);
  const std::string file = folder / "run/results.csv";
  const auto read = read_results(test::dortmans_file(), test::read_file(file), file, out);
  ASSERT_TRUE(read.has_value()) << test::messages(out);
  EXPECT_EQ(out.items().size(), 0u) << test::messages(out);
  EXPECT_EQ(read->left_out, 0u);
  ASSERT_EQ(read->solution.records.size(), solution.records.size());
  for (std::size_t row = 0; row < solution.records.size(); ++row) {
    const State &was = solution.records[row].point.pose.state, &is = read->solution.records[row].point.pose.state;
    ASSERT_EQ(is.poses.size(), was.poses.size());
    for (std::size_t b = 0; b < was.poses.size(); ++b) {
      EXPECT_LT((is.poses[b].p - was.poses[b].p).norm(), 1e-15);
      EXPECT_LT((is.poses[b].R - was.poses[b].R).norm(), 1e-14);
    }
    ASSERT_EQ(is.contacts.size(), was.contacts.size()) << row;
    for (std::size_t c = 0; c < was.contacts.size(); ++c) {
      EXPECT_EQ(is.contacts[c].force, was.contacts[c].force);
      EXPECT_LT((is.contacts[c].geometry.b.p - was.contacts[c].geometry.b.p).norm(), 1e-12);
      EXPECT_LT((is.contacts[c].geometry.a.n - was.contacts[c].geometry.a.n).norm(), 1e-9);
    }
  }
  EXPECT_EQ(read->solution.poses.columns(), solution.poses.columns());
  EXPECT_EQ(read->solution.poses.number(40, "AAC.strain"), solution.poses.number(40, "AAC.strain"));
}

TEST(ReadResults, LeavesOutRowsWithoutAPoseAndKeepsTheNumbersOfOthers) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  ASSERT_EQ(run_scene(folder.write("s.toml", test::kBall), folder / "run", {}, out, nullptr), kExitOk);
  std::string text = test::read_file(folder / "run/results.csv");
  text = test::with_first(text, "\n1,1,0.20000000000000001,ok,", "\n1,1,0.20000000000000001,no_equilibrium,");
  const auto read = read_results(folder / "s.toml", text, "results.csv", out);
  ASSERT_TRUE(read.has_value()) << test::messages(out);
  EXPECT_EQ(read->left_out, 1u);
  EXPECT_EQ(read->numbers, (std::vector<std::size_t>{1, 3, 4, 5, 6}));
  EXPECT_EQ(read->solution.poses.rows(), 5u);
}

TEST(ReadResults, AContactOffItsSurfaceIsToldAndLeftOut) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  ASSERT_EQ(run_scene(folder.write("s.toml", test::kBall), folder / "run", {}, out, nullptr), kExitOk);
  const std::string file = folder / "run/results.csv", text = test::read_file(file);
  const std::string other = folder.write("t.toml", test::with_first(test::kBall, "radius = 20", "radius = 21"));
  EXPECT_FALSE(read_results(other, text, file, out).has_value());
  EXPECT_TRUE(test::contains(test::messages(out), "medial: lies off its surface in 6 rows, all in which it carries"));

  // In one row alone: the others are good.
  std::string moved = text;
  const std::size_t names = moved.find('\n'), row = moved.find('\n', names + 1) + 1;
  const auto column = std::count(moved.begin(), moved.begin() + static_cast<long>(moved.find("medial.ball.x_mm")), ',');
  std::size_t cell = row;
  for (long k = 0; k < column; ++k) cell = moved.find(',', cell) + 1;
  moved.replace(cell, moved.find_first_of(",\n", cell) - cell, "1");
  Diagnostics told;
  const auto read = read_results(folder / "s.toml", moved, file, told);
  ASSERT_TRUE(read.has_value()) << test::messages(told);
  EXPECT_TRUE(read->solution.records[1].point.pose.state.contacts.empty());
  EXPECT_FALSE(read->solution.records[0].point.pose.state.contacts.empty());
  EXPECT_TRUE(test::contains(test::messages(told), "medial: lies off its surface in 1 row, and is left out there"));
}

TEST(ReadResults, RefusesWhatIsNoResult) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", test::kBall);
  const std::string names = "knee.flexion_deg,knee.adduction_deg,knee.rotation_deg,knee.x_mm,knee.y_mm,knee.z_mm";
  const auto why = [&](const std::string& text) {
    Diagnostics out;
    EXPECT_FALSE(read_results(scene, text, "results.csv", out).has_value());
    return test::messages(out);
  };
  EXPECT_TRUE(test::contains(why(names + "\n0,0,0,0,0,20\n"), "no results.csv of genu"));
  const std::string head = "step,increment,status,medial.force_N," + names + "\n";
  EXPECT_TRUE(test::contains(why(head + "1,0,ok,1O,0,0,0,0,0,20\n"), "results.csv:2:8: medial.force_N"));
  EXPECT_TRUE(test::contains(why(head + "1,0,lost,1,0,0,0,0,0,20\n"), "holds no pose that was solved"));
  EXPECT_TRUE(test::contains(why("step,increment,status\n1,0,ok\n"), "no column gives"));
}

}  // namespace
}  // namespace genu
