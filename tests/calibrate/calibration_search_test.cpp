#include "genu/calibrate/calibration_search.h"

#include <memory>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/made_up_experiment.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"
#include "support/wheel_knee.h"

namespace genu {
namespace {

/// Five rows that depend on two unknowns linearly; the last does not exist where the first unknown is within a band.
class BandedExperiment : public test::MadeUpExperiment {
 public:
  BandedExperiment(Vec2 truth, double low, double high) : truth_(std::move(truth)), low_(low), high_(high) {
    columns_ = {{"x_mm", 1, false}};
    for (Eigen::Index k = 0; k < slopes_.rows(); ++k) values_.push_back({0, slopes_.row(k).dot(truth_)});
  }
  CalibrationPrediction predict(const VecX& u, bool) const override {
    CalibrationPrediction out;
    VecX values = slopes_ * u;
    MatX derivatives = slopes_;
    if (u[0] > low_ && u[0] < high_) {
      out.failed = "ends early";
      values[4] = 0;
      derivatives.row(4).setZero();
      out.part = {values, derivatives, {true, true, true, true, false}};
    } else {
      out.values = values;
      out.derivatives = derivatives;
    }
    return out;
  }

 private:
  MatX slopes_{{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 0.5}};
  Vec2 truth_;
  double low_, high_;
};

class CalibrationSearches : public ::testing::Test {
 protected:
  void SetUp() override {
    auto scene = read_scene(folder_.write("scene.toml", test::wheel_knee()), out_);
    ASSERT_TRUE(scene) << test::messages(out_);
    unknowns_ = choose_unknowns(*scene, {{"ahead.slack_length", "ahead.stiffness"}, {}, {}}, out_);
    ASSERT_EQ(unknowns_.size(), 2u) << test::messages(out_);
  }
  CalibrationSearch search_in_band(const Vec2& truth, double low, double high) {
    experiments_.clear();
    experiments_.push_back(std::make_unique<BandedExperiment>(truth, low, high));
    const CalibrationProblem problem(unknowns_, experiments_, 1e-4);
    return search(problem, {}, solvable_start(problem, VecX::Zero(2)));
  }

  test::TemporaryFolder folder_;
  Diagnostics out_;
  std::vector<CalibrationUnknown> unknowns_;
  std::vector<std::unique_ptr<CalibrationExperiment>> experiments_;
};

TEST_F(CalibrationSearches, PassWhereARowDoesNotExist) {
  const Vec2 truth(-0.08, 0.1);
  // Wider than the longest step of a slack length.
  const CalibrationSearch found = search_in_band(truth, -0.07, -0.005);
  EXPECT_TRUE(converged(found.fit.stop)) << to_string(found.fit.stop);
  EXPECT_LT((found.fit.x - truth).norm(), 1e-9);
  EXPECT_EQ(found.at_end.residuals.size(), 5);
  EXPECT_EQ(found.starts.size(), 1u);
}

TEST_F(CalibrationSearches, AreNotConvergedWhereARowDoesNotExist) {
  const CalibrationSearch found = search_in_band({-0.08, 0.1}, -0.2, -0.005);
  EXPECT_FALSE(converged(found.fit.stop));
  ASSERT_EQ(found.at_end.residuals.size(), 5) << "the last numbers with all rows";
  EXPECT_GE(found.fit.x[0], -0.005);
  EXPECT_LE(found.fit.residuals.squaredNorm(),
            found.at_start.residuals.squaredNorm());  // the first step may leave them
}

}  // namespace
}  // namespace genu
