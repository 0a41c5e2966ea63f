// Candidates are ranked by standard errors that a fit of the same tests reports.
#include "genu/calibrate/calibration_design.h"

#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "genu/calibrate/calibrate.h"
#include "genu/core/units.h"
#include "genu/study/laxity.h"
#include "genu/study/laxity_table.h"
#include "support/csv_table.h"
#include "support/scenes.h"
#include "support/text.h"
#include "support/wheel_knee.h"

namespace genu {
namespace {

class CalibrationDesigns : public testing::Test {
 protected:
  /// Rows of a laxity table of the knee, each load once: of one test, or of all for "".
  std::string table(const std::vector<double>& degrees, const std::string& test) {
    LaxityChoice tests;
    tests.tests = {{LaxityTest::Kind::drawer, 20}, {LaxityTest::Kind::varus, 1}, {LaxityTest::Kind::rotation, 0.2}};
    tests.increments = 2;
    for (const double angle : degrees) tests.flexions.push_back(units::kDegree * angle);
    LaxityResult measured;
    Diagnostics out;
    EXPECT_EQ(run_laxity(folder_.write("truth.toml", test::wheel_knee()), {}, tests, out, measured), kExitOk);
    std::istringstream lines(laxity_csv(measured.scenes));
    std::string line, kept;
    std::set<std::string> taken;
    std::getline(lines, line);
    kept = line + "\n";
    while (std::getline(lines, line)) {
      std::array<std::string, 5> cells;
      std::stringstream row(line);
      for (std::string& cell : cells) std::getline(row, cell, ',');
      if ((test.empty() || cells[2] == test) && taken.insert(cells[1] + cells[2] + cells[3] + cells[4]).second)
        kept += line + "\n";
    }
    return kept;
  }

  int calibrate(CalibrationChoice choice) {
    out_ = {};
    result_ = {};
    if (choice.vary.empty()) choice.vary = {"ahead.slack_length", "across.slack_length", "behind.slack_length"};
    return run_calibration(folder_.write("knee.toml", test::wheel_knee()), folder_ / "out", choice, {}, out_, result_);
  }

  ResultTable csv(const std::string& name) { return test::read_table(folder_ / ("out/" + name)); }

  test::TemporaryFolder folder_;
  Diagnostics out_;
  CalibrationResult result_;
};

TEST_F(CalibrationDesigns, StandardErrorsAreThoseOfAFitOfBoth) {
  CalibrationChoice choice;
  choice.errors = {"displacement_mm=0.3", "displacement_deg=0.5"};
  choice.priors = {"*.slack_length=start~5%"};
  choice.targets = {folder_.write("measured.csv", table({0}, "drawer"))};
  choice.candidates = {folder_.write("candidates.csv", table({0, 10}, ""))};
  ASSERT_EQ(calibrate(choice), kExitOk) << test::messages(out_) << to_text(result_.report);
  const ResultTable ranked = csv("design.csv"), order = csv("design_order.csv");
  ASSERT_EQ(ranked.rows(), 7u) << "none, three tests at two angles";
  EXPECT_EQ(std::get<std::string>(ranked.at(1, 0)), std::get<std::string>(order.at(0, 0)));
  for (std::size_t row = 1; row < ranked.rows(); ++row)
    EXPECT_GE(ranked.number(row, "narrowing"), row == 1 ? 0 : ranked.number(row - 1, "narrowing"));
  EXPECT_LT(ranked.number(1, "narrowing"), 0.95);
  for (std::size_t row = 1; row < order.rows(); ++row)
    EXPECT_LT(order.number(row, "narrowing"), order.number(row - 1, "narrowing"));
  const std::string best = std::get<std::string>(ranked.at(1, 0));
  const std::size_t comma = best.find(" deg, ");
  ASSERT_NE(comma, std::string::npos) << best;
  CalibrationChoice both = choice;
  both.candidates.clear();
  both.targets.push_back(folder_.write("best.csv", table({std::stod(best.substr(0, comma))}, best.substr(comma + 6))));
  ASSERT_EQ(calibrate(both), kExitOk) << test::messages(out_);
  double worst = 0;
  for (const auto& p : result_.report.parameters)
    worst = std::max(worst, std::abs(ranked.number(1, p.name) / p.deviation - 1));
  std::printf("best: %s, worst standard error %.2g of itself\n", best.c_str(), worst);
  EXPECT_LT(worst, 1e-6);
}

TEST_F(CalibrationDesigns, BeforeAnythingIsMeasured) {
  CalibrationChoice choice;
  choice.errors = {"displacement_*=0.3"};
  choice.candidates = {folder_.write("candidates.csv", table({0, 10}, ""))};
  choice.narrow = {"ahead.*"};
  ASSERT_EQ(calibrate(choice), kExitOk) << test::messages(out_);
  const ResultTable ranked = csv("design.csv");
  ASSERT_EQ(ranked.rows(), 7u);
  EXPECT_EQ(ranked.columns(), (std::vector<std::string>{"test", "narrowing", "ahead.slack_length"}));
  EXPECT_NEAR(ranked.number(0, "ahead.slack_length"), 2.5, 1e-6) << "10 standard changes of 1 % of 25 mm";
  EXPECT_NEAR(ranked.number(1, "narrowing"), ranked.number(1, "ahead.slack_length") / 2.5, 1e-9);
  EXPECT_LT(ranked.number(1, "ahead.slack_length"), 0.9 * 2.5);
  EXPECT_TRUE(test::contains(result_.text, "each the best beside those before")) << result_.text;
}

/// A test that ends before its load is not ranked as one that tells nothing.
TEST_F(CalibrationDesigns, WhatCannotBeMadeIsNotRanked) {
  CalibrationChoice choice;
  choice.errors = {"displacement_*=0.3"};
  choice.candidates = {
      folder_.write("far.csv", "flexion_deg,test,load_N,displacement_mm\n0,drawer,1e9,0\n5,drawer,50,0\n")};
  ASSERT_EQ(calibrate(choice), kExitOk) << test::messages(out_);
  EXPECT_EQ(csv("design.csv").rows(), 2u) << result_.text;
  EXPECT_TRUE(test::contains(result_.text, "not ranked")) << result_.text;
}

TEST_F(CalibrationDesigns, WhatCannotBeRankedIsRefused) {
  const auto refused = [&](const CalibrationChoice& choice, const std::string& said) {
    EXPECT_EQ(calibrate(choice), kExitRefused) << said;
    EXPECT_TRUE(test::contains(test::messages(out_), said)) << test::messages(out_);
  };
  CalibrationChoice choice;
  choice.candidates = {folder_.write("candidates.csv", table({0}, "drawer"))};
  refused(choice, "--design needs them");
  choice.candidates = {folder_.write("run.csv", "time_s,knee.x_mm\n0,1\n")};
  refused(choice, "must be a laxity table");
  choice.candidates = {folder_ / "none.csv"};
  refused(choice, "none.csv");
  choice.errors = {"displacement_*=0.3"};
  choice.candidates = {folder_.write("candidates.csv", table({0}, "drawer"))};
  choice.narrow = {"ZZ*"};
  refused(choice, "is no number that --vary names: those are ahead.slack_length");
  choice.narrow.clear();
  choice.errors = {"displacement_*=1e-154"};
  refused(choice, "SIGMA with a number from 1e-12");
  choice.errors = {};
  choice.candidates = {};
  choice.narrow = {"ahead.*"};
  refused(choice, "needs --design");
  choice.narrow = {};
  refused(choice, "there is nothing to follow");
}

}  // namespace
}  // namespace genu
