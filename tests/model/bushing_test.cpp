// Bushings: displacement, wrench and stiffness against definitions, energy and differences.
#include "genu/model/bushing.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "genu/model/tolerances.h"
#include "support/wrench_difference.h"

namespace genu {
namespace {

using test::random_pose;
using test::relative_error;
using test::twist_difference;

/// Any symmetric positive definite stiffness, with rows of forces and moments of the sizes that joints have.
Bushing random_bushing(std::mt19937& generator) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Mat6 L;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) L(i, j) = (i < 3 ? 300 : 3) * unit(generator);
  Bushing b{"b", 0, 1, {}, {}};
  b.frame_a = random_pose(generator, 0.05);
  b.frame_b = random_pose(generator, 0.05);
  b.stiffness = L * L.transpose();
  return b;
}

/// Poses of A and B with the frames apart by `turn` rad about some axis and a few mm.
std::pair<Pose, Pose> poses_apart(std::mt19937& generator, const Bushing& b, double turn) {
  const Pose X_WA = random_pose(generator, 0.1), away = random_pose(generator, 0.005);
  const Vec3 axis = log_rotation(away.R).normalized();
  return {X_WA, X_WA * b.frame_a * Pose{exp_rotation(turn * axis), away.p} * b.frame_b.inverse()};
}

TEST(Bushing, DisplacementIsThatOfTheSecondFrameInTheFirst) {
  std::mt19937 generator(1);
  const Bushing b = random_bushing(generator);
  const Pose X_WA = random_pose(generator, 0.1);
  const Vec3 place(0.001, -0.002, 0.003), turn(0.4, -1.2, 0.9);
  const Pose X_WB = X_WA * b.frame_a * Pose{exp_rotation(turn), place} * b.frame_b.inverse();
  const Vec6 q = BushingPoint(b, X_WA, X_WB).displacement();
  EXPECT_LT((q.head<3>() - place).norm(), 1e-15);
  EXPECT_LT((q.tail<3>() - turn).norm(), 1e-14);
}

TEST(Bushing, SeriesAndClosedFormMeet) {
  for (const double at : {kLogSeriesAngle, 0.5 * kLogSeriesAngle, 0.05}) {
    // By the closed form in long double.
    const long double a = at, half = a / 2, cot = 1 / std::tan(half), c = (1 - half * cot) / (a * a);
    const long double slope = (-(cot / 2 - a / (4 * std::sin(half) * std::sin(half))) / (a * a) - 2 * c / a) / a;
    for (const double x : {std::nextafter(at, 0), std::nextafter(at, 1)}) {
      EXPECT_NEAR(log_series(x).c, static_cast<double>(c), 1e-15) << x;
      EXPECT_NEAR(log_series(x).slope, static_cast<double>(slope), 3e-13) << x;
    }
  }
  EXPECT_DOUBLE_EQ(log_series(0).c, 1.0 / 12);
  EXPECT_DOUBLE_EQ(log_series(0).slope, 1.0 / 360);
}

TEST(Bushing, JacobianIsThatOfTheLogarithm) {
  std::mt19937 generator(2);
  for (const double angle : {0.0, 1e-9, 1e-3, 0.19, 0.21, 1.0, 2.0, 3.0}) {
    const Vec3 t = angle * log_rotation(random_pose(generator, 1).R).normalized();
    const double h = 1e-3;
    Mat3 by_differences;
    for (int i = 0; i < 3; ++i) {
      const auto moved = [&](double s) { return log_rotation(exp_rotation(s * Vec3::Unit(i)) * exp_rotation(t)); };
      by_differences.col(i) = (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
    }
    EXPECT_LT((inverse_left_jacobian(t) - by_differences).norm(), 1e-10) << angle;
  }
}

TEST(Bushing, GradientWrenchAndStiffnessAreDerivatives) {
  std::mt19937 generator(3);
  for (const double turn : {0.0, 1e-7, 0.01, 0.199, 0.3, 1.5, 2.8}) {
    const Bushing b = random_bushing(generator);
    const auto [X_WA, X_WB] = poses_apart(generator, b, turn);
    const BushingPoint point(b, X_WA, X_WB);
    const auto q = [&](const Pose& a, const Pose& other) -> VecX { return BushingPoint(b, a, other).displacement(); };
    EXPECT_LT(relative_error(point.gradient(), twist_difference(q, X_WA, X_WB)), 1e-9) << turn;
    const auto energy = [&](const Pose& a, const Pose& other) -> VecX {
      return VecX::Constant(1, energy_of(b, a, other));
    };
    const Vec6 f = -b.stiffness * point.displacement();
    EXPECT_LT(relative_error(-point.wrench(f).transpose(), twist_difference(energy, X_WA, X_WB)), 2e-8) << turn;
    const auto wrench = [&](const Pose& a, const Pose& other) -> VecX {
      const BushingPoint there(b, a, other);
      return there.wrench(-b.stiffness * there.displacement());
    };
    const MatX exact = point.wrench_rate(f) - point.gradient().transpose() * b.stiffness * point.gradient();
    EXPECT_LT(relative_error(exact, twist_difference(wrench, X_WA, X_WB, 2e-4)), 1e-8) << turn;
  }
}

TEST(Bushing, ForcesCancelAndFrameMomentsAreThoseOnTheBody) {
  std::mt19937 generator(4);
  const Bushing b = random_bushing(generator);
  const auto [X_WA, X_WB] = poses_apart(generator, b, 1.1);
  const BushingPoint point(b, X_WA, X_WB);
  const Vec6 f = -b.stiffness * point.displacement();
  const Vec12 w = point.wrench(f);
  EXPECT_LT((w.segment<3>(0) + w.segment<3>(6)).norm(), 1e-12 * w.norm());
  const Vec3 about_world =
      w.segment<3>(3) + X_WA.p.cross(w.segment<3>(0)) + w.segment<3>(9) + X_WB.p.cross(w.segment<3>(6));
  EXPECT_LT(about_world.norm(), 1e-12 * w.norm()) << "no net moment";
  const Mat3 R = (X_WA * b.frame_a).R;
  const Vec6 shown = point.on_frame(f);
  EXPECT_LT((R * shown.head<3>() - w.segment<3>(6)).norm(), 1e-12 * w.norm());
  const Vec3 arm = (X_WB * b.frame_b).p - X_WB.p;
  EXPECT_LT((R * shown.tail<3>() + arm.cross(w.segment<3>(6)) - w.segment<3>(9)).norm(), 1e-12 * w.norm());
}

TEST(Bushing, TurnedAboutOneAxisItsMomentIsStiffnessTimesAngle) {
  Bushing b{"b", 0, 1, {}, {}};
  b.stiffness.diagonal() << 1e4, 1e4, 1e4, 5, 6, 7;
  for (const double angle : {-3.0, -0.1, 1e-12, 0.7, 2.9})
    for (int axis = 0; axis < 3; ++axis) {
      const Pose turned{exp_rotation(angle * Vec3::Unit(axis)), Vec3::Zero()};
      const BushingPoint point(b, {}, turned);
      const Vec12 w = point.wrench(-b.stiffness * point.displacement());
      EXPECT_NEAR(w[9 + axis], -(5 + axis) * angle, 1e-12);
      EXPECT_LT(w.segment<3>(6).norm(), 1e-12);
    }
}

}  // namespace
}  // namespace genu
