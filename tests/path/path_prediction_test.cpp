// What a path is predicted to do next, against a motion that is known everywhere.
#include "genu/path/path_prediction.h"

#include "support/known_motion.h"

namespace genu {
namespace {

using test::KnownMotion;

/// The error of a prediction `h` beyond 0.4, with the tangents of there and of so many poses before, 0.6 h and more
/// apart.
double prediction_error(const JointModel& model, double h, int before) {
  PathPrediction prediction(model);
  double t = 0.4 - h * (0.6 * before + 0.1 * (before - 1) * before / 2);
  for (int k = before; k > 0; --k) {
    const double span = h * (0.6 + 0.1 * (k - 1));
    const KnownMotion from(model, t), to(model, t + span);
    prediction.went_on(span, from.tangent, to.tangent);
    t += span;
  }
  const KnownMotion here(model, 0.4), there(model, 0.4 + h);
  State found;
  EXPECT_TRUE(prediction.at(here.state, here.tangent, h, found));
  return distance(there, found);
}

TEST(PathPrediction, ErrsWithOnePowerOfTheStepMoreForEachTangentItKnows) {
  const JointModel model = test::one_bone();
  for (const double h : {0.04, 0.02, 0.01}) {
    EXPECT_NEAR(prediction_error(model, h, 0) / prediction_error(model, h / 2, 0), 4, 0.3) << h;
    EXPECT_NEAR(prediction_error(model, h, 1) / prediction_error(model, h / 2, 1), 8, 0.8) << h;
    EXPECT_NEAR(prediction_error(model, h, 2) / prediction_error(model, h / 2, 2), 16, 3) << h;
    EXPECT_LT(prediction_error(model, h, 1), 0.1 * prediction_error(model, h, 0)) << h;
  }
  EXPECT_LT(prediction_error(model, 0.01, 2), 0.5 * prediction_error(model, 0.01, 1));
  EXPECT_LT(prediction_error(model, 0.01, 3), 0.5 * prediction_error(model, 0.01, 2));
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

TEST(PathPrediction, DoesNotEnlargeRounding) {
  const JointModel model = test::one_bone();
  const double h = 0.02;
  // Tangents known to 1e-12, over spans that end a row: 1e-16 and the like.
  for (const double span : {1e-16, 1e-12, 1e-8, 1e-6}) {
    const KnownMotion before(model, 0.4 - h - span), near(model, 0.4 - span), here(model, 0.4), there(model, 0.4 + h);
    PathPrediction fresh(model), told(model);
    Correction inexact = near.tangent;
    inexact.twist *= 1 + 1e-12;
    told.went_on(h, before.tangent, inexact);
    told.went_on(span, inexact, here.tangent);
    State plain, found;
    ASSERT_TRUE(fresh.at(here.state, here.tangent, h, plain));
    ASSERT_TRUE(told.at(here.state, here.tangent, h, found));
    EXPECT_LE(distance(there, found), 1.01 * distance(there, plain)) << span;
  }
}

TEST(PathPrediction, ForgetsWhereOtherUnknownsAreHeld) {
  const JointModel model = test::one_bone();
  const double h = 0.02;
  const KnownMotion before(model, 0.4 - h), here(model, 0.4);
  PathPrediction fresh(model), changed(model);
  changed.went_on(h, before.tangent, here.tangent);
  Correction other = here.tangent;
  other.multipliers.resize(3);
  changed.went_on(h, other, here.tangent);
  State one, same;
  ASSERT_TRUE(fresh.at(here.state, here.tangent, h, one));
  ASSERT_TRUE(changed.at(here.state, here.tangent, h, same));
  EXPECT_EQ(one.poses, same.poses);
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
