// Rotations against their closed forms and against long double; retraction against its definition.
#include "genu/core/pose.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/wrench_difference.h"

namespace genu {
namespace {

using test::random_pose;

constexpr double kPi = std::numbers::pi;

Vec3 random_direction(std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return Vec3{normal(generator), normal(generator), normal(generator)}.normalized();
}

/// The exponential's own series, in long double: true to 1e-18 for angles up to pi.
Mat3 series_exp(const Vec3& w) {
  using Mat3l = Eigen::Matrix<long double, 3, 3>;
  const Mat3l k = skew(w).cast<long double>();
  Mat3l sum = Mat3l::Identity(), term = Mat3l::Identity();
  for (int n = 1; n < 60; ++n) {
    term = (term * k / n).eval();
    sum += term;
  }
  return sum.cast<double>();
}

TEST(Pose, SkewIsTheCrossProduct) {
  const Vec3 a(1, -2, 3), b(-4, 5, 0.5);
  EXPECT_EQ((skew(a) * b - a.cross(b)).norm(), 0);
}

TEST(Pose, QuarterTurnAboutZTakesXToY) {
  const Mat3 R = exp_rotation({0, 0, kPi / 2});
  EXPECT_NEAR((R * Vec3::UnitX() - Vec3::UnitY()).norm(), 0, 2e-16);
}

TEST(Pose, ExpMatchesTheSeriesForEveryAngle) {
  std::mt19937 generator(1);
  double worst = 0, worst_angle = 0;
  for (double angle : {0.0, 1e-300, 1e-160, 1e-12, 1e-8, 0.99e-4, 1e-4, 1.01e-4, 1e-3, 0.1, 1.0, 3.0, kPi, 6.0}) {
    const Vec3 w = angle * random_direction(generator);
    const double error = (exp_rotation(w) - series_exp(w)).cwiseAbs().maxCoeff();
    if (error > worst) worst = error, worst_angle = angle;
  }
  EXPECT_LT(worst, 4e-15) << "at angle " << worst_angle;
}

TEST(Pose, LogInvertsExpNearZeroAndNearPi) {
  std::mt19937 generator(2);
  double worst = 0, worst_angle = 0;
  for (double angle : {1e-12, 1e-8, 1e-4, 1e-2, 1.0, 2.0, 3.0, kPi - 1e-3, kPi - 1e-6, kPi - 1e-9})
    for (int i = 0; i < 100; ++i) {
      const Vec3 w = angle * random_direction(generator);
      const double error = (log_rotation(exp_rotation(w)) - w).norm();
      if (error > worst) worst = error, worst_angle = angle;
    }
  EXPECT_LT(worst, 1e-14) << "at angle " << worst_angle;
  EXPECT_EQ(log_rotation(Mat3::Identity()).norm(), 0);
}

TEST(Pose, LogOfSmallRotationsKeepsRelativeAccuracy) {
  const Vec3 w(3e-9, -4e-9, 1e-9);
  EXPECT_LT((log_rotation(exp_rotation(w)) - w).norm(), 1e-15 * w.norm());
}

TEST(Pose, LogOfAHalfTurnHasLengthPi) {
  std::mt19937 generator(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 n = random_direction(generator);
    const Vec3 w = log_rotation(2 * n * n.transpose() - Mat3::Identity());
    EXPECT_NEAR(w.norm(), kPi, 1e-14);
    EXPECT_NEAR(w.cross(n).norm(), 0, 1e-14);  // n or -n: both are the same half turn
  }
}

TEST(Pose, CompositionAndInverseActOnPoints) {
  std::mt19937 generator(4);
  const Pose X_WA = random_pose(generator, 2), X_AB = random_pose(generator, 2);
  const Vec3 p_B(0.3, -1, 2);
  EXPECT_LT(((X_WA * X_AB) * p_B - X_WA * (X_AB * p_B)).norm(), 1e-14);
  EXPECT_LT((X_WA.inverse() * (X_WA * p_B) - p_B).norm(), 1e-14);
}

TEST(Pose, RetractMovesTheOriginAndTurnsAboutIt) {
  std::mt19937 generator(5);
  const Pose X = random_pose(generator, 1);
  Vec6 twist;
  twist << 0.1, -0.2, 0.3, 0.4, 0.5, -0.6;
  const Pose Y = retract(X, twist);
  EXPECT_LT((Y.p - (X.p + twist.head<3>())).norm(), 1e-15);
  EXPECT_LT((Y.R - series_exp(twist.tail<3>()) * X.R).norm(), 4e-15);
}

TEST(Pose, RetractStaysARotationOverAMillionSteps) {
  std::mt19937 generator(6);
  Pose X = random_pose(generator, 1);
  Vec6 twist;
  twist << 0, 0, 0, 1e-2, -2e-2, 3e-2;
  for (int i = 0; i < 1000000; ++i) X = retract(X, twist);
  EXPECT_LT((X.R.transpose() * X.R - Mat3::Identity()).norm(), 4e-15);
}

TEST(Pose, DerivativeOfAPointIsTheTwistsVelocity) {
  std::mt19937 generator(7);
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const Pose A = random_pose(generator, 1), B = random_pose(generator, 1);
    const Vec3 p_B(0.2, -0.5, 0.7);
    const MatX fd = test::twist_difference([&](const Pose&, const Pose& X) { return VecX(X * p_B); }, A, B);
    MatX exact = MatX::Zero(3, 12);
    exact.block<3, 3>(0, 6).setIdentity();
    exact.block<3, 3>(0, 9) = -skew(B.R * p_B);
    worst = std::max(worst, test::relative_error(exact, fd));
  }
  EXPECT_LT(worst, 1e-11);
}

}  // namespace
}  // namespace genu
