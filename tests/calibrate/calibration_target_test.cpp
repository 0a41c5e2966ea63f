#include "genu/calibrate/calibration_target.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

const std::vector<std::string> kKnown = {"step", "time_s", "status", "a.angle_deg", "b.angle_deg"};

class ReadTarget : public testing::Test {
 protected:
  std::optional<CalibrationTarget> read(const std::string& text, const std::vector<std::string>& patterns = {}) {
    out_ = {};
    return read_calibration_target(folder_.write("t.csv", text), patterns, kKnown, 2, out_);
  }

  void refused(const std::string& text, int line, int column, const std::string& rule,
               const std::vector<std::string>& patterns = {}) {
    SCOPED_TRACE(text);
    EXPECT_FALSE(read(text, patterns));
    ASSERT_EQ(out_.items().size(), 1u) << test::messages(out_);
    EXPECT_EQ(out_.items()[0].line, line);
    EXPECT_EQ(out_.items()[0].column, column);
    EXPECT_NE(out_.items()[0].rule.find(rule), std::string::npos) << out_.items()[0].rule;
  }

  test::TemporaryFolder folder_;
  Diagnostics out_;
};

TEST_F(ReadTarget, TakesItsColumnsAndLeavesEmptyCellsOut) {
  const auto t = read("step,time_s,b.angle_deg,status,a.angle_deg\n1,0,5,ok,+1\n1,0.5,,ok,3e0\n1,2,5,ok,5\n");
  ASSERT_TRUE(t) << test::messages(out_);
  ASSERT_EQ(t->columns.size(), 2u);
  EXPECT_EQ(t->columns[0].name, "b.angle_deg");
  EXPECT_EQ(t->columns[0].scale, 5) << "does not change: its size";
  EXPECT_NEAR(t->columns[1].scale, std::sqrt(8.0 / 3), 1e-15);
  ASSERT_EQ(t->values.size(), 5u);
  EXPECT_EQ(t->values[2].time, 0.5);
  EXPECT_EQ(t->values[2].column, 1u);
  EXPECT_EQ(t->values[2].value, 3);
  const auto one = read("time_s,a.angle_deg,b.angle_deg\n0,1,2\n", {"b.*"});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->columns.size(), 1u);
  EXPECT_EQ(one->values[0].value, 2);
}

TEST_F(ReadTarget, Errors) {
  refused("time_s,a.angel_deg\n0,1\n", 1, 8, "did you mean \"a.angle_deg\"?");
  refused("a.angle_deg\n1\n", 1, 1, "says when each of its rows is");
  refused("time_s\n1\n", 1, 1, "has no column to follow");
  refused("time_s,a.angle_deg\n0,1\n", 1, 1, "is no column of the target", {"c.*"});
  refused("time_s,a.angle_deg\n0,1\n", 1, 1, "did you mean \"a.angle_deg\"?", {"a.angle_deg", "a.angel_deg"});
  refused("time_s,a.angle_deg\n0,1e300\n", 2, 3, "of at most 1e20");
  refused("time_s,a.angle_deg\n0,nan\n", 2, 3, "must be a finite number");
  refused("time_s,a.angle_deg\n0,inf\n", 2, 3, "must be a finite number");
  refused("time_s,a.angle_deg\n0,1x\n", 2, 3, "must be a finite number");
  refused("time_s,a.angle_deg\n0,1\n2.5,1\n", 3, 1, "outside of what the scene computes: 0 to 2 s");
  refused("time_s,a.angle_deg\n-0.1,1\n", 2, 1, "outside");
  refused("time_s,a.angle_deg\n0,\n", 1, 1, "holds no values");
  refused("time_s,a.angle_deg\n", 0, 0, "holds no");
  EXPECT_FALSE(read(""));
  EXPECT_FALSE(read_calibration_target(folder_ / "none.csv", {}, kKnown, 2, out_));
  read("time_s,a.angle_deg,c\n3,nan,1\n");
  EXPECT_EQ(out_.items().size(), 1u) << "names first: " << test::messages(out_);
  read("time_s,a.angle_deg\n3,nan\n");
  EXPECT_EQ(out_.items().size(), 2u) << "all at once";
}

TEST_F(ReadTarget, OnlyWhatIsUsedIsChecked) {
  EXPECT_TRUE(read("time_s,a.angle_deg,x,x\n0,1,word,\n", {"a.*"})) << test::messages(out_);
  refused("time_s,a.angle_deg,a.angle_deg\n0,1,2\n", 1, 20, "is the name of the column at 8 as well");
}

TEST_F(ReadTarget, DecimalCommas) {
  const auto t = read("time_s;a.angle_deg\n0,5;-1,25\n");
  ASSERT_TRUE(t) << test::messages(out_);
  EXPECT_EQ(t->values[0].time, 0.5);
  EXPECT_EQ(t->values[0].value, -1.25);
  refused("time_s;a.angle_deg\n0.5;-1,25\n0.6;-1,35\n", 2, 5, "write the table with decimal points");
}

/// Rows every 0.1 s of a cubic, which is followed exactly, and of a sine.
TEST_F(ReadTarget, ValuesBetweenRowsAreThoseOfACubic) {
  ResultTable table;
  for (const char* name : {"time_s", "a.angle_deg", "b.angle_deg"}) table.add_column(name);
  const auto cubic = [](double t) { return 1 + t - 3 * t * t + 2 * t * t * t; };
  for (int k = 0; k <= 20; ++k) {
    const double t = 0.1 * k;
    table.add_row();
    table.set("time_s", t);
    table.set("a.angle_deg", cubic(t));
    table.set("b.angle_deg", std::sin(t));
  }
  CalibrationTarget target;
  target.columns = {{"a.angle_deg", 1}, {"b.angle_deg", 1}};
  const double times[] = {0, 0.04, 0.3, 0.333, 1.07, 1.96, 2};
  for (const double t : times)
    for (const std::size_t c : {0u, 1u}) target.values.push_back({t, c, 0});
  const auto values = values_at(target, table);
  ASSERT_TRUE(values);
  for (Eigen::Index k = 0; k < 7; ++k) {
    EXPECT_NEAR((*values)[2 * k], cubic(times[k]), 1e-13) << times[k];
    EXPECT_NEAR((*values)[2 * k + 1], std::sin(times[k]), 0.1 * 0.1 * 0.1 * 0.1 / 24) << times[k];
  }
  EXPECT_EQ((*values)[4], cubic(0.1 * 3)) << "a row's own";
  table.add_row();
  table.set("time_s", 2.1);
  target.values = {{2.1, 0, 0}};
  EXPECT_FALSE(values_at(target, table)) << "a cell is empty";
  EXPECT_FALSE(values_at(target, ResultTable{}));
}

}  // namespace
}  // namespace genu
