// Starts: what is slack is made taut where it is longest; rows that cannot be solved are, with shorter lengths.
#include "genu/calibrate/calibration_starts.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/made_up_experiment.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"
#include "support/wheel_knee.h"

namespace genu {
namespace {

/// Has rows where the first unknown is at most a limit.
class LimitedExperiment : public test::MadeUpExperiment {
 public:
  explicit LimitedExperiment(double limit) : limit_(limit) {
    columns_ = {{"x_mm", 1, false}};
    values_ = {{0, 0.0}};
  }
  CalibrationPrediction predict(const VecX& u, bool) const override {
    CalibrationPrediction out;
    if (u[0] > limit_)
      out.failed = "too long";
    else
      out.values = VecX::Constant(1, u[0]), out.derivatives = MatX::Constant(1, u.size(), 1);
    return out;
  }

 private:
  double limit_;
};

class CalibrationStarts : public ::testing::Test {
 protected:
  void SetUp() override {
    auto scene = read_scene(folder_.write("scene.toml", test::wheel_knee()), out_);
    ASSERT_TRUE(scene) << test::messages(out_);
    unknowns_ = choose_unknowns(*scene, {{"ahead.slack_length", "ahead.stiffness"}, {}, {}}, out_);
    ASSERT_EQ(unknowns_.size(), 2u) << test::messages(out_);
  }
  SolvableStart start(double limit) {
    experiments_.clear();
    experiments_.push_back(std::make_unique<LimitedExperiment>(limit));
    return solvable_start(CalibrationProblem(unknowns_, experiments_, 1e-4), VecX::Zero(2));
  }

  test::TemporaryFolder folder_;
  Diagnostics out_;
  std::vector<CalibrationUnknown> unknowns_;
  std::vector<std::unique_ptr<CalibrationExperiment>> experiments_;
};

TEST_F(CalibrationStarts, AreTheScenesNumbersWhereRowsAreSolved) {
  const SolvableStart s = start(1);
  EXPECT_EQ(s.how, "");
  EXPECT_EQ(s.at.u, VecX(VecX::Zero(2)));
  EXPECT_EQ(s.at.residuals.size(), 1);
}

TEST_F(CalibrationStarts, AreShorterWhereRowsAreNotSolved) {
  const SolvableStart s = start(std::log(1 - 0.03));
  EXPECT_EQ(s.how, "lengths 4 % shorter");
  EXPECT_NEAR(s.at.u[0], std::log(0.96), 1e-12);
  EXPECT_EQ(s.at.u[1], 0) << "a stiffness stays";
  EXPECT_EQ(s.at.residuals.size(), 1);
  const SolvableStart none = start(-1);
  EXPECT_EQ(none.at.residuals.size(), 0);
  EXPECT_EQ(none.at.failed, "too long");
}

TEST_F(CalibrationStarts, AreWithinBounds) {
  unknowns_[0].lower = std::log(0.99);
  EXPECT_EQ(start(std::log(0.97)).at.residuals.size(), 0) << "none within the bounds";
}

TEST_F(CalibrationStarts, MakeTautWhereItIsLongest) {
  // 3 % short of taut: the length at which it is stretched by 2 % is 0.97 / 1.02 of its own.
  const auto taut = taut_start(unknowns_[0], 0, {{0.97, true}}, 0.02);
  ASSERT_TRUE(taut);
  EXPECT_NEAR(*taut, std::log(0.97 / 1.02), 1e-12);
  EXPECT_FALSE(taut_start(unknowns_[1], 0, {{0, true}}, 0.02)) << "a stiffness has no such length";
  unknowns_[0].lower = std::log(0.99);
  EXPECT_FALSE(taut_start(unknowns_[0], 0, {{0.97, true}}, 0.02)) << "beyond its bound";
}

}  // namespace
}  // namespace genu
