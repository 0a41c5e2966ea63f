// A path's length, and each derivative against differences of it.
#include "genu/model/ligament_path.h"

#include <random>

#include <gtest/gtest.h>

#include "genu/model/ligament_law.h"
#include "genu/surface/analytic.h"

namespace genu {
namespace {

constexpr double kStep = 1e-6;  // m and rad: central differences are good to about 1e-10 of a length

/// Four points on three bodies, of which the middle one is fixed.
LigamentPath bent_path() {
  LigamentPath path(
      {{0, {0.01, -0.02, 0.03}}, {1, {0.02, 0.01, -0.01}}, {2, {-0.01, 0.03, 0.01}}, {2, {0.02, 0.0, -0.03}}});
  path.move_with({0, -1, 1});
  return path;
}

std::vector<Pose> some_poses() {
  return {{exp_rotation(Vec3(0.3, -0.2, 0.1)), Vec3(0.01, 0.02, 0.05)},
          {},
          {exp_rotation(Vec3(-0.1, 0.4, 0.2)), Vec3(-0.02, 0.01, -0.06)}};
}

std::vector<Pose> moved(std::vector<Pose> poses, const VecX& twist) {
  const int bodies[] = {0, 2};
  for (int k = 0; k < 2; ++k) {
    Pose& pose = poses[at(bodies[k])];
    pose.p += twist.segment<3>(6 * k);
    pose.R = exp_rotation(twist.segment<3>(6 * k + 3)) * pose.R;
  }
  return poses;
}

/// f at the ends of a step along each of the twelve motions, as columns of differences.
template <typename F>
MatX differences(const F& f) {
  MatX out(f(some_poses()).size(), 12);
  for (int i = 0; i < 12; ++i) {
    const VecX step = kStep * VecX::Unit(12, i);
    out.col(i) = (f(moved(some_poses(), step)) - f(moved(some_poses(), -step))) / (2 * kStep);
  }
  return out;
}

TEST(LigamentPath, LengthIsTheSumOfItsLines) {
  const LigamentPath path({{0, {0, 0, 0}}, {0, {0.03, 0, 0}}, {0, {0.03, 0.04, 0}}});
  EXPECT_NEAR(path.length({Pose()}), 0.07, 1e-17);
  EXPECT_FALSE(path.is_straight());
  EXPECT_TRUE(LigamentPath({{0, {0, 0, 0}}, {0, {0.03, 0, 0}}}).is_straight());
}

TEST(LigamentPath, GradientAndRateAreTheLengthsDerivatives) {
  const LigamentPath path = bent_path();
  const MatX by_difference = differences([&](const auto& poses) { return VecX::Constant(1, path.length(poses)); });
  const VecX gradient = path.length_gradient(some_poses(), 2);
  EXPECT_LT((gradient - by_difference.row(0).transpose()).cwiseAbs().maxCoeff(), 1e-9);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> entry(-1, 1);
  const VecX twist = VecX::NullaryExpr(12, [&] { return entry(random); });
  EXPECT_NEAR(path.length_rate(some_poses(), twist), gradient.dot(twist), 1e-14);
}

TEST(LigamentPath, WrenchIsMinusTensionTimesGradient) {
  const LigamentPath path = bent_path();
  VecX wrench = VecX::Constant(12, 2), gradient;
  path.add_tension(some_poses(), 7, wrench);
  const VecX expected = VecX::Constant(12, 2) - 7 * path.length_gradient(some_poses(), 2);
  EXPECT_LT((wrench - expected).cwiseAbs().maxCoeff(), 1e-14);
  VecX again = VecX::Constant(12, 2);
  path.linearize(some_poses(), {7, 100, 0}, gradient, again, nullptr);
  EXPECT_LT((again - expected).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((gradient - path.length_gradient(some_poses(), 2)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(LigamentPath, StiffnessIsTheWrenchsDerivative) {
  const LigamentPath path = bent_path();
  // T = 3 + 500 (L - L0): a tension that grows with the length.
  const double start = path.length(some_poses());
  const auto wrench_at = [&](const std::vector<Pose>& poses) {
    VecX out = VecX::Zero(12);
    path.add_tension(poses, 3 + 500 * (path.length(poses) - start), out);
    return out;
  };
  VecX gradient, wrench = VecX::Zero(12);
  MatX stiffness = MatX::Zero(12, 12);
  path.linearize(some_poses(), {3, 500, 0}, gradient, wrench, &stiffness);
  EXPECT_LT((stiffness - differences(wrench_at)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(LigamentPath, LinesWithinOneBodyAndOnFixedOnesExertNothing) {
  LigamentPath path({{0, {0, 0, 0}}, {1, {0.03, 0, 0}}, {1, {0.03, 0.04, 0}}});
  path.move_with({-1, -1});
  EXPECT_EQ(path.length_gradient({Pose(), Pose()}, 1), VecX::Zero(6));
}

/// The same to fourth order, where derivatives change within millimetres.
template <typename F>
MatX fine_differences(const F& f) {
  MatX out(f(some_poses()).size(), 12);
  for (int i = 0; i < 12; ++i) {
    const auto across = [&](double h) {
      const VecX step = h * VecX::Unit(12, i);
      return VecX((f(moved(some_poses(), step)) - f(moved(some_poses(), -step))) / (2 * h));
    };
    out.col(i) = (4 * across(kStep) - across(2 * kStep)) / 3;
  }
  return out;
}

/// From body 0 to body 2 over a ball on the fixed body 1 and an ellipsoid or rod on body 2, with a via point on body 1
/// behind them and another ball on body 0 after that.
LigamentPath wrapped_path(std::shared_ptr<const Surface> second) {
  LigamentPath path({{0, {0.0, 0.0, 0.0}}, {1, {0.09, 0.005, -0.10}}, {2, {0.02, 0.08, -0.03}}});
  const std::vector<Pose> poses = some_poses();
  const auto in_body = [&](int body, const Vec3& world) -> Vec3 { return poses[at(body)].inverse() * world; };
  path.set_point(0, in_body(0, Vec3(-0.06, 0.0, 0.001)));
  path.set_point(1, Vec3(0.07, 0.0, -0.002));
  path.set_point(2, in_body(2, Vec3(0.075, 0.06, 0.01)));
  path.set_obstacles(
      {{"ball", 1, make_sphere({Mat3::Identity(), Vec3(-0.03, -0.004, 0)}, 0.01, false), 0, Vec3(0, 1, 0)},
       {"second", 2, std::move(second), 0, Vec3(poses[2].R.transpose() * Vec3(0, -1, 0))},
       {"third", 0, make_sphere({Mat3::Identity(), in_body(0, Vec3(0.082, 0.03, 0.004))}, 0.012, false), 1}},
      0);
  path.move_with({0, -1, 1});
  return path;
}

std::vector<std::shared_ptr<const Surface>> second_obstacles() {
  const Pose X = some_poses()[2].inverse() * Pose{exp_rotation(Vec3(0.2, 0.1, 0.4)), Vec3(0.03, 0.006, 0)};
  return {make_ellipsoid(X, Vec3(0.02, 0.012, 0.016), false), make_cylinder(X, 0.012, false)};
}

/// The touches at moved poses, from those of some_poses().
Wraps followed(const LigamentPath& path, const std::vector<Pose>& poses, const Wraps& from) {
  Wraps out = from;
  EXPECT_TRUE(path.follow_touches(poses, out));
  return out;
}

void expect_derivatives(const LigamentPath& path, const Wraps& wraps, double tolerance) {
  const auto length = [&](const auto& poses) {
    return VecX::Constant(1, path.length(poses, followed(path, poses, wraps)));
  };
  const VecX gradient = path.length_gradient(some_poses(), 2, wraps);
  EXPECT_LT((fine_differences(length) - gradient.transpose()).cwiseAbs().maxCoeff(), tolerance);
  const auto pull = [&](const auto& poses) {
    VecX out = VecX::Zero(12);
    path.add_tension(poses, 1, out, followed(path, poses, wraps));
    return out;
  };
  VecX same, wrench = VecX::Zero(12);
  MatX stiffness = MatX::Zero(12, 12);
  path.linearize(some_poses(), {1, 0, 0}, same, wrench, &stiffness, wraps);
  EXPECT_LT((same - gradient).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((fine_differences(pull) - stiffness).cwiseAbs().maxCoeff(), tolerance * stiffness.cwiseAbs().maxCoeff());
}

TEST(WrappedPath, DerivativesAreThoseOfItsLength) {
  for (const auto& second : second_obstacles()) {
    const LigamentPath path = wrapped_path(second);
    Wraps wraps(3);
    ASSERT_TRUE(path.find_touches(some_poses(), wraps));
    for (const WrapTouch& touch : wraps) EXPECT_TRUE(touch.touching);
    EXPECT_TRUE(path.is_shortest(some_poses(), wraps));
    expect_derivatives(path, wraps, 2e-9);
  }
}

/// A line that cuts a rod, or clears it, by a nanometre: the touching path goes on smoothly to arcs of negative length.
TEST(WrappedPath, DerivativesBesideTheTouchAreExactToo) {
  for (const double depth : {1e-9, -1e-9, 0.0}) {
    LigamentPath path({{0, {0, 0, 0}}, {2, {0, 0, 0}}});
    const std::vector<Pose> poses = some_poses();
    path.set_point(0, poses[0].inverse() * Vec3(-0.05, 0.01 - depth, 0.003));
    path.set_point(1, poses[2].inverse() * Vec3(0.04, 0.01 - depth, -0.002));
    path.set_obstacles({{"rod", 1, make_cylinder({}, 0.01, false), 0, Vec3(0, 1, 0)}}, 0);
    path.move_with({0, -1, 1});
    Wraps wraps(1);
    wraps[0].touching = true;
    wraps[0].arc.begin.p = Vec3(0, 0.01, 0);
    wraps[0].arc.begin.t = Vec3(0.09, 0, -0.005).normalized();
    wraps[0].arc.length = 1e-5;
    ASSERT_TRUE(path.follow_touches(poses, wraps));
    EXPECT_NEAR(path.touch_margin(poses, wraps, 0), wraps[0].arc.length, 0);
    EXPECT_LT(std::abs(wraps[0].arc.length), depth == 0 ? 1e-17 : 1e-8);  // without a depth rounding has the sign
    EXPECT_TRUE(depth == 0 || (wraps[0].arc.length > 0) == (depth > 0));
    expect_derivatives(path, wraps, 2e-9);
  }
}

TEST(WrappedPath, PointsInsideAnObstacleAreFound) {
  LigamentPath path({{0, {0, 0, 0}}, {0, {0.05, 0, 0}}});
  path.set_obstacles({{"ball", 0, make_sphere({Mat3::Identity(), Vec3(0.045, 0, 0)}, 0.01, false), 0}}, 0);
  const auto inside = path.points_inside({Pose()});
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_EQ(inside[0].point, 1u);
  EXPECT_NEAR(inside[0].depth, 0.005, 1e-15);
}

/// A belt round a pulley under one tension: the bearing carries 2 T sin(phi / 2).
TEST(WrappedPath, ABeltPressesOnItsPulley) {
  constexpr double kTension = 37, kRadius = 0.03;
  for (const double phi : {0.1, 1.0, 2.5, 3.0}) {
    const Vec3 from(-0.2, kRadius, 0), along(std::cos(phi), -std::sin(phi), 0), out(std::sin(phi), std::cos(phi), 0);
    LigamentPath path({{0, from}, {0, kRadius * out + 0.2 * along}});
    path.set_obstacles(
        {{"pulley", 1, make_cylinder({}, kRadius, false), 0, Vec3(std::sin(phi / 2), std::cos(phi / 2), 0)}}, 0);
    path.move_with({-1, 0});
    Wraps wraps(1);
    ASSERT_TRUE(path.find_touches({{}, {}}, wraps));
    EXPECT_NEAR(wraps[0].arc.length, kRadius * phi, 1e-14);
    VecX wrench = VecX::Zero(6);
    path.add_tension({{}, {}}, kTension, wrench, wraps);
    EXPECT_NEAR(wrench.head<3>().norm(), 2 * kTension * std::sin(phi / 2), 1e-12 * kTension);
    EXPECT_LT(wrench.tail<3>().norm(), 1e-12 * kTension * kRadius);
  }
}

}  // namespace
}  // namespace genu
