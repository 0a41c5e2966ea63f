// Bloemker's rule on a small knee: lengths are those of the poses, and a fit that starts there finds the truth.
#include "genu/calibrate/zero_load.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "genu/calibrate/calibrate.h"
#include "genu/core/units.h"
#include "genu/study/laxity.h"
#include "genu/study/laxity_table.h"
#include "support/scenes.h"
#include "support/text.h"
#include "support/wheel_knee.h"

namespace genu {
namespace {

class ZeroLoad : public testing::Test {
 protected:
  int calibrate(const CalibrationChoice& choice, const std::array<double, 5>& slack = {26, 21, 20, 25, 25}) {
    out_ = {};
    result_ = {};
    return run_calibration(folder_.write("start.toml", test::wheel_knee(slack)), folder_ / "out", choice, {}, out_,
                           result_);
  }

  CalibrationChoice with_poses() {
    CalibrationChoice choice;
    choice.vary = {"*.slack_length"};
    choice.zero_load.poses = {folder_.write("poses.csv", passive_.to_csv())};
    return choice;
  }

  double longest(const std::string& ligament) const {
    double most = 0;
    for (std::size_t row = 0; row < passive_.rows(); ++row)
      most = std::max(most, passive_.number(row, ligament + ".length_mm"));
    return most;
  }

  test::TemporaryFolder folder_;
  ResultTable passive_ = test::table_of(test::wheel_knee());
  Diagnostics out_;
  CalibrationResult result_;
};

TEST_F(ZeroLoad, LengthsAreTheLongestTimesTheCorrection) {
  CalibrationChoice choice = with_poses();
  choice.zero_load.correction = {"0.95", "ahead=0.9"};
  const int code = calibrate(choice);
  ASSERT_TRUE(all_solved(code)) << code << test::messages(out_);
  Diagnostics out;
  const auto made = prepare({folder_ / "out/scene.toml", {}}, out);
  ASSERT_TRUE(made) << test::messages(out);
  ASSERT_EQ(made->model.ligaments.size(), 5u);
  double worst = 0;
  for (const auto& ligament : made->model.ligaments) {
    const double factor = ligament.name == "ahead" ? 0.9 : 0.95;
    worst = std::max(worst, std::abs(1e3 * ligament.law.slack_length() - factor * longest(ligament.name)));
  }
  std::printf("worst length %.2g mm\n", worst);
  EXPECT_LT(worst, 1e-9);
  EXPECT_TRUE(test::contains(result_.text, "zero_load_mm")) << result_.text;
  EXPECT_TRUE(result_.report.parameters.empty()) << "nothing is fitted";
  EXPECT_TRUE(test::contains(test::read_file(folder_ / "out/zero_load.csv"), "ahead,"));
}

TEST_F(ZeroLoad, TheFitStartsThere) {
  LaxityChoice tests;
  tests.tests = {{LaxityTest::Kind::drawer, 20}, {LaxityTest::Kind::varus, 1}, {LaxityTest::Kind::rotation, 0.2}};
  tests.increments = 4;
  tests.flexions = {0, 10 * units::kDegree};
  LaxityResult measured;
  Diagnostics out;
  ASSERT_EQ(run_laxity(folder_.write("truth.toml", test::wheel_knee()), {}, tests, out, measured), kExitOk);
  CalibrationChoice choice = with_poses();
  choice.vary = {"ahead.slack_length", "across.slack_length", "behind.slack_length"};
  choice.zero_load.correction = {"0.93"};
  choice.targets = {folder_.write("target.csv", laxity_csv(measured.scenes))};
  ASSERT_EQ(calibrate(choice, {30, 20, 19.2, 24, 24}), kExitOk) << test::messages(out_) << to_text(result_.report);
  const double truth[] = {25, 24, 24};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& p = result_.report.parameters[k];
    EXPECT_NEAR(p.start, 0.93 * longest(p.name.substr(0, p.name.find('.'))), 1e-9);
    EXPECT_NEAR(p.value / truth[k], 1, 1e-6);
  }
}

TEST_F(ZeroLoad, WhatIsOfNoUseIsRefused) {
  const auto refused = [&](const CalibrationChoice& choice, const std::string& said) {
    EXPECT_EQ(calibrate(choice), kExitRefused) << said;
    EXPECT_TRUE(test::contains(test::messages(out_), said)) << test::messages(out_);
  };
  CalibrationChoice choice = with_poses();
  choice.zero_load.correction = {"ACL=0.9"};
  refused(choice, "with ligaments of this scene");
  choice.zero_load.correction = {"-1"};
  refused(choice, "--correction");
  choice.zero_load.correction = {};
  choice.vary = {"*.stiffness"};
  refused(choice, "needs slack lengths");
  choice = with_poses();
  choice.zero_load.poses = {folder_.write("bad.csv", "knee.x_mm\n1\n")};
  refused(choice, "knee");
  choice.zero_load = {{}, {"0.9"}};
  refused(choice, "needs --zero-load");
}

}  // namespace
}  // namespace genu
