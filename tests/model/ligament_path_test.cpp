// A path's length, and each derivative against differences of it.
#include "genu/model/ligament_path.h"

#include <random>

#include <gtest/gtest.h>

#include "genu/model/ligament_law.h"

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

}  // namespace
}  // namespace genu
