// Residuals of experiments that are made up, with priors, against what the definition gives by hand.
#include "genu/calibrate/calibration_problem.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/made_up_experiment.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/wheel_knee.h"

namespace genu {
namespace {

/// y = (u0 u0, u0 u1, sin u1), the second column with another error; the last may be missing, derivatives too.
class CurvedExperiment : public test::MadeUpExperiment {
 public:
  explicit CurvedExperiment(bool exact) : exact_(exact) {
    columns_ = {{"x_mm", 0.5, true}, {"a_deg", 2, true}};
    values_ = {{0, 1.0}, {1, -1.0}, {0, 0.25}};
  }
  CalibrationPrediction predict(const VecX& u, bool derivatives) const override {
    CalibrationPrediction out;
    VecX y(3);
    y << u[0] * u[0], u[0] * u[1], std::sin(u[1]);
    MatX J(3, 2);
    J << 2 * u[0], 0, u[1], u[0], 0, std::cos(u[1]);
    if (!derivatives || !exact_) J.resize(0, 0);
    if (last_is_missing) {
      y[2] = 0;
      if (J.size() > 0) J.row(2).setZero();
      out.failed = "ends early";
      out.part = {y, J, {true, true, false}};
    } else {
      out.values = y;
      out.derivatives = J;
    }
    return out;
  }
  bool last_is_missing = false;

 private:
  bool exact_;
};

class CalibrationProblems : public ::testing::Test {
 protected:
  void SetUp() override {
    auto scene = read_scene(folder_.write("scene.toml", test::wheel_knee()), out_);
    ASSERT_TRUE(scene) << test::messages(out_);
    unknowns_ = choose_unknowns(*scene, {{"ahead.slack_length", "ahead.stiffness"}, {}, {}}, out_);
    ASSERT_EQ(unknowns_.size(), 2u) << test::messages(out_);
  }
  CurvedExperiment& add(bool exact) {
    auto made = std::make_unique<CurvedExperiment>(exact);
    CurvedExperiment& out = *made;
    experiments_.push_back(std::move(made));
    return out;
  }

  test::TemporaryFolder folder_;
  Diagnostics out_;
  std::vector<CalibrationUnknown> unknowns_;
  std::vector<std::unique_ptr<CalibrationExperiment>> experiments_;
  const VecX u_ = Vec2(0.3, -0.2);
};

TEST_F(CalibrationProblems, ResidualsAreDifferencesOverErrors) {
  add(true);
  const CalibrationProblem problem(unknowns_, experiments_, 1e-5);
  const auto here = problem.at(u_, true);
  ASSERT_EQ(here.residuals.size(), 3);
  EXPECT_NEAR(here.residuals[0], (0.09 - 1) / 0.5, 1e-15);
  EXPECT_NEAR(here.residuals[1], (-0.06 + 1) / 2, 1e-15);
  EXPECT_NEAR(here.residuals[2], (std::sin(-0.2) - 0.25) / 0.5, 1e-15);
  EXPECT_NEAR(here.derivatives(1, 0), -0.2 / 2, 1e-15);
  EXPECT_EQ(problem.runs(), 1);
  EXPECT_TRUE(problem.has_stated_errors());
}

TEST_F(CalibrationProblems, DifferencesTakeThePlaceOfMissingDerivatives) {
  add(true);
  const MatX exact = CalibrationProblem(unknowns_, experiments_, 1e-5).at(u_, true).derivatives;
  add(false);
  const CalibrationProblem problem(unknowns_, experiments_, 1e-5);
  const auto here = problem.at(u_, true);
  EXPECT_EQ(here.derivatives.size(), 0) << "one experiment has none";
  const auto J = problem.jacobian(here);
  ASSERT_TRUE(J);
  EXPECT_LT((J->topRows(3) - exact).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((J->bottomRows(3) - exact).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(CalibrationProblems, PriorsAreTheLastRows) {
  add(true);
  unknowns_[1].prior = CalibrationUnknown::Prior{unknowns_[1].shown(0.1), 2.5};
  const CalibrationProblem problem(unknowns_, experiments_, 1e-5);
  const auto here = problem.at(u_, true);
  ASSERT_EQ(here.residuals.size(), 4);
  EXPECT_EQ(problem.target_rows(), 3);
  EXPECT_NEAR(here.residuals[3], (unknowns_[1].shown(-0.2) - unknowns_[1].shown(0.1)) / 2.5, 1e-12);
  EXPECT_EQ(here.derivatives(3, 0), 0);
  EXPECT_NEAR(here.derivatives(3, 1), unknowns_[1].shown_slope(-0.2) / 2.5, 1e-12);
}

TEST_F(CalibrationProblems, WhatIsHeldOutIsNotFollowed) {
  add(true);
  add(true).held_out = true;
  const CalibrationProblem problem(unknowns_, experiments_, 1e-5);
  EXPECT_EQ(problem.at(u_, true).residuals.size(), 3);
  EXPECT_EQ(problem.runs(), 1);
}

TEST_F(CalibrationProblems, RowsThatDoNotExistAreZeroAndSaidToBeMissing) {
  add(true);
  add(true).last_is_missing = true;
  const CalibrationProblem problem(unknowns_, experiments_, 1e-5);
  const auto here = problem.at(u_, true);
  EXPECT_TRUE(here.is_partial());
  EXPECT_EQ(here.residuals.size(), 0);
  EXPECT_EQ(here.failed, "ends early");
  ASSERT_EQ(here.some.size(), 6);
  EXPECT_EQ(here.there, (std::vector<bool>{true, true, true, true, true, false}));
  EXPECT_EQ(here.some[5], 0);
  EXPECT_EQ(here.some_derivatives.row(5).norm(), 0);
  EXPECT_LT((here.some.head(2) - here.some.segment(3, 2)).norm(), 1e-15);
}

TEST_F(CalibrationProblems, AMisfitIsOneBeyondChance) {
  add(true);
  const CalibrationProblem problem(unknowns_, experiments_, 1e-5);
  EXPECT_FALSE(problem.misfit(VecX::Ones(200), 2)) << "as large as the errors";
  const auto large = problem.misfit(VecX::Constant(200, 3), 2);
  ASSERT_TRUE(large);
  EXPECT_NEAR(*large, 9 * 200 / 198.0, 1e-12);
}

}  // namespace
}  // namespace genu
