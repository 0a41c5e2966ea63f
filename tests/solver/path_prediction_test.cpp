// What a path is predicted to do next, against a motion that is known everywhere.
#include "genu/solver/path_prediction.h"

#include "solver/known_motion.h"

namespace genu {
namespace {

using test::KnownMotion;

/// The error of a prediction `h` beyond 0.4, with the tangents of there and, if asked, of 0.6 h before.
double prediction_error(const JointModel& model, double h, bool two) {
  const KnownMotion before(model, 0.4 - 0.6 * h), here(model, 0.4), there(model, 0.4 + h);
  PathPrediction prediction(model);
  if (two) prediction.went_on(0.6 * h, before.tangent, here.tangent);
  State found;
  EXPECT_TRUE(prediction.at(here.state, here.tangent, h, found));
  return distance(there, found);
}

TEST(PathPrediction, ErrsWithTheSquareOfTheStepAndWithTwoTangentsWithItsCube) {
  const JointModel model = test::one_bone();
  for (const double h : {0.04, 0.02, 0.01}) {
    EXPECT_NEAR(prediction_error(model, h, false) / prediction_error(model, h / 2, false), 4, 0.3) << h;
    EXPECT_NEAR(prediction_error(model, h, true) / prediction_error(model, h / 2, true), 8, 0.8) << h;
    EXPECT_LT(prediction_error(model, h, true), 0.1 * prediction_error(model, h, false)) << h;
  }
}

TEST(PathPrediction, ForgetsAndDoesNotGoOnWithAKink) {
  const JointModel model = test::one_bone();
  const double h = 0.02;
  const KnownMotion before(model, 0.4 - h), here(model, 0.4);
  PathPrediction fresh(model), forgetful(model), kinked(model);
  forgetful.went_on(h, before.tangent, here.tangent);
  forgetful.forget();
  Correction opposite = here.tangent;
  opposite.twist *= -1;
  kinked.went_on(h, opposite, here.tangent);
  State one, other, third;
  ASSERT_TRUE(fresh.at(here.state, here.tangent, h, one));
  ASSERT_TRUE(forgetful.at(here.state, here.tangent, h, other));
  ASSERT_TRUE(kinked.at(here.state, here.tangent, h, third));
  EXPECT_EQ(one.poses, other.poses);
  EXPECT_EQ(one.poses, third.poses);
}

TEST(PathPrediction, SpeedCountsLengthsAndRadians) {
  const JointModel model = test::one_bone();
  Correction tangent;
  tangent.resize(1, 0, 0);
  tangent.twist << 3 * model.scales.length, 0, 4 * model.scales.length, 0, 2, 0;
  EXPECT_NEAR(path_speed(model, tangent), 5 + 2, 1e-12);
}

}  // namespace
}  // namespace genu
