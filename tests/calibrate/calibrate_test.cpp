// Numbers that made a target are found again; what a target does not say is told.
#include "genu/calibrate/calibrate.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/scene/reader.h"
#include "support/judged.h"
#include "support/leskovar.h"
#include "support/scenes.h"

namespace genu {
namespace {

const std::vector<std::string> kAll = {"j1.stiffness", "j1.damping", "j2.stiffness", "j2.damping"};
constexpr double kTruth[] = {0.5535, 0.001, 0.033, 0.001};  // per degree

class Calibrate : public testing::Test {
 protected:
  int run(const std::string& scene, const std::string& target, const std::vector<std::string>& vary,
          const std::vector<std::string>& columns = {}) {
    out_ = {};
    result_ = {};
    CalibrationChoice choice{{target}, vary, columns};
    choice.most_iterations = most_;
    return run_calibration(scene, folder_ / "out", choice, {}, out_, result_);
  }

  void refused(const std::vector<std::string>& vary, const std::string& key, const std::string& rule) {
    SCOPED_TRACE(rule);
    EXPECT_EQ(run(test::kLeskovar + "calibration.toml", kTarget, vary), kExitRefused);
    ASSERT_EQ(out_.items().size(), 1u) << test::messages(out_);
    EXPECT_EQ(out_.items()[0].key, key);
    EXPECT_NE(out_.items()[0].rule.find(rule), std::string::npos) << out_.items()[0].rule;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }

  const std::string kTarget = test::kLeskovar + "calibration-target.csv";
  test::TemporaryFolder folder_;
  Diagnostics out_;
  CalibrationResult result_;
  int most_ = 50;
};

TEST_F(Calibrate, TheCommittedTargetIsThatOfTheTruth) {
  Diagnostics out;
  Solution truth;
  ASSERT_EQ(test::judged_run(folder_.write("truth.toml", test::leskovar_truth()), folder_ / "out", {}, out, &truth),
            kExitOk);
  std::istringstream lines(test::read_file(kTarget));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "time_s,j1.angle_deg,j2.angle_deg");
  std::size_t row = 0;
  for (; std::getline(lines, line); ++row) {
    double t = 0, a = 0, b = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &t, &a, &b), 3);
    ASSERT_LT(row, truth.poses.rows());
    EXPECT_EQ(t, truth.poses.number(row, "time_s"));
    EXPECT_NEAR(a, truth.poses.number(row, "j1.angle_deg"), 1e-9);
    EXPECT_NEAR(b, truth.poses.number(row, "j2.angle_deg"), 1e-9);
  }
  EXPECT_EQ(row, truth.poses.rows());
}

TEST_F(Calibrate, FindsStiffnessAndDampingOfBothJoints) {
  ASSERT_EQ(run(test::kLeskovar + "calibration.toml", kTarget, kAll), kExitOk) << test::messages(out_);
  const CalibrationReport& r = result_.report;
  EXPECT_TRUE(r.converged) << r.stop;
  EXPECT_LE(r.iterations, 20);
  EXPECT_GT(r.start_rms, 0.1);
  EXPECT_LT(r.rms, 1e-8);
  ASSERT_EQ(r.parameters.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GT(std::abs(r.parameters[k].start / kTruth[k] - 1), 0.3);
    EXPECT_NEAR(r.parameters[k].value / kTruth[k], 1, 1e-6) << r.parameters[k].name;
    EXPECT_LT(r.parameters[k].deviation, 1e-6 * kTruth[k]);
  }
  EXPECT_TRUE(r.undetermined.empty());
  EXPECT_NEAR(r.correlation(0, 2), 0, 1e-4) << "the joints know nothing of each other";
  // The written scene is the fitted one, and gives the results beside it.
  Diagnostics out;
  const auto written = read_scene(folder_ / "out/scene.toml", out);
  ASSERT_TRUE(written) << test::messages(out);
  EXPECT_NEAR(written->joints[0].stiffness * units::kDegree / kTruth[0], 1, 1e-6);
  EXPECT_NEAR(written->joints[1].damping * units::kDegree / kTruth[3], 1, 1e-6);
  Solution again;
  ASSERT_EQ(test::judged_run(folder_ / "out/scene.toml", folder_ / "again", {}, out, &again), kExitOk);
  for (std::size_t row = 0; row < again.poses.rows(); ++row)
    EXPECT_NEAR(again.poses.number(row, "j1.angle_deg"), result_.solution.poses.number(row, "j1.angle_deg"), 6e-8)
        << "1e-9 rad, the tolerance: digits of the numbers choose other steps";
  for (const char* file : {"calibration.csv", "comparison.csv", "results.csv", "summary.json"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("out/") + file))) << file;
}

/// Noise of 0.05 deg: what is found is off the truth by about the standard errors that are claimed.
TEST_F(Calibrate, StandardErrorsAreThoseOfTheNoise) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.05);
  const std::string scene = folder_.write("truth.toml", test::leskovar_truth());
  constexpr int kTrials = 12;
  double square = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::istringstream lines(test::read_file(kTarget));
    std::string line, noisy = "time_s,j1.angle_deg\n";
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      double t = 0, a = 0;
      ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf", &t, &a), 2);
      noisy += std::to_string(t) + "," + std::to_string(a + noise(random)) + "\n";
    }
    ASSERT_EQ(run(scene, folder_.write("noisy.csv", noisy), {"j1.*"}), kExitOk) << test::messages(out_);
    for (std::size_t k = 0; k < 2; ++k) {
      const CalibrationReport::Parameter& p = result_.report.parameters[k];
      square += std::pow((p.value - kTruth[k]) / p.deviation, 2) / (2 * kTrials);
    }
    EXPECT_NEAR(result_.report.columns[0].rms, 0.05, 0.01);
  }
  std::printf("chi-square %.3f\n", square);
  EXPECT_GT(square, 0.45);  // chi-square of 24 over 24: 0.45 to 1.8 in 98 of 100 cases
  EXPECT_LT(square, 1.8);
}

TEST_F(Calibrate, SaysWhatTheTargetDoesNotDetermine) {
  EXPECT_EQ(run(test::kLeskovar + "calibration.toml", kTarget, {"j1.*", "j2.stiffness"}, {"j1.angle_deg"}),
            kExitIncomplete)
      << test::messages(out_);
  const CalibrationReport& r = result_.report;
  EXPECT_TRUE(r.converged) << r.stop;
  ASSERT_EQ(r.parameters.size(), 3u);
  EXPECT_NEAR(r.parameters[0].value / kTruth[0], 1, 1e-6) << "the others are found all the same";
  EXPECT_NEAR(r.parameters[1].value / kTruth[1], 1, 1e-6);
  EXPECT_FALSE(std::isfinite(r.parameters[2].deviation));
  EXPECT_NEAR(r.parameters[2].value, r.parameters[2].start, 1e-9) << "and it stays where it was";
  EXPECT_EQ(r.undetermined, std::vector<std::string>{"j2.stiffness"});
  EXPECT_NE(to_text(r).find("undetermined"), std::string::npos);
}

TEST_F(Calibrate, StopsAfterTheMostIterations) {
  most_ = 1;
  EXPECT_EQ(run(test::kLeskovar + "calibration.toml", kTarget, kAll), kExitIncomplete);
  EXPECT_FALSE(result_.report.converged);
  EXPECT_NE(result_.report.stop.find("most iterations"), std::string::npos);
}

TEST_F(Calibrate, Errors) {
  refused({"j1.stifness"}, "--vary", "did you mean \"j1.stiffness\"?");
  refused({"j3.*"}, "--vary", "is no parameter of this scene");
  const std::string scene = test::kLeskovar + "calibration.toml";
  const auto target_refused = [&](const std::string& text, const std::string& rule) {
    EXPECT_EQ(run(scene, folder_.write("t.csv", text), kAll), kExitRefused);
    ASSERT_EQ(out_.items().size(), 1u) << test::messages(out_);
    EXPECT_NE(out_.items()[0].rule.find(rule), std::string::npos) << out_.items()[0].rule;
  };
  target_refused("time_s,j1.angel_deg\n0,1\n", "did you mean");
  target_refused("time_s,j1.angle_deg\n0,1\n1,nan\n", "must be a finite number");
  target_refused("time_s,j1.angle_deg\n0,1\n2.1,3\n", "outside of what the scene computes");
  target_refused("time_s,j1.angle_deg\n", "holds no");
  target_refused("time_s,j1.angle_deg\n0,40\n1,3\n", "holds 2 values, fewer than the 4 numbers to be fitted");
  EXPECT_EQ(run(folder_ / "none.toml", kTarget, kAll), kExitRefused);
  EXPECT_EQ(run(scene, folder_ / "none.csv", kAll), kExitRefused);
  // All at once.
  EXPECT_EQ(run(scene, folder_.write("t.csv", "time_s,x\n0,1\n"), {"a.b", "c.d"}), kExitRefused);
  EXPECT_EQ(out_.items().size(), 3u) << test::messages(out_);
}

/// A path of equilibria: a lever on a spring, its angle against a moment that grows with time.
TEST_F(Calibrate, FollowsPathsOfEquilibriaToo) {
  const auto lever = [](const std::string& stiffness, const std::string& strain) {
    return R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.lever]
[joint.h]
type = "revolute"
parent = "ground"
child = "lever"
axis = [0, 0, 1]
stiffness = )" +
           stiffness + R"(
[ligament.cord]
from = { body = "ground", point = [60, 20, 0] }
to = { body = "lever", point = [0, 50, 0] }
law = "linear"
stiffness = 900
reference_strain = )" +
           strain + R"(
[load.turn]
on = "h.angle"
value = 12
[[step]]
load = { turn = [0, 1] }
increments = 20
)";
  };
  Diagnostics out;
  Solution truth;
  ASSERT_EQ(test::judged_run(folder_.write("truth.toml", lever("0.3", "0.02")), folder_ / "truth", {}, out, &truth),
            kExitOk)
      << test::messages(out);
  std::filesystem::copy_file(folder_ / "truth/results.csv", folder_ / "target.csv");
  ASSERT_EQ(run(folder_.write("scene.toml", lever("0.2", "0.035")), folder_ / "target.csv",
                {"h.stiffness", "cord.reference_strain"}, {"h.angle_deg", "cord.force_N"}),
            kExitOk)
      << test::messages(out_);
  EXPECT_NEAR(result_.report.parameters[0].value, 0.3, 1e-7) << "N m/deg";
  EXPECT_NEAR(result_.report.parameters[1].value, 0.02, 1e-8);
  const auto written = read_scene(folder_ / "out/scene.toml", out);
  ASSERT_TRUE(written);
  EXPECT_NEAR(written->ligaments[0].rest_value, 0.02, 1e-8);
}

}  // namespace
}  // namespace genu
