// Loads: closed forms, the derivative against finite differences, and what tells a follower from a dead load.
#include "genu/model/load.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/wrench_difference.h"

namespace genu {
namespace {

using test::random_pose;

LoadDef some_load(LoadDef::Frame frame) {
  LoadDef load;
  load.force = {10, -20, 35};
  load.moment = {0.4, 1.1, -0.7};
  load.point = {0.02, -0.05, 0.03};
  load.frame = frame;
  return load;
}

TEST(Load, WeightOnALever) {
  LoadDef load;
  load.force = {0, 0, -10};
  load.point = {0.2, 0, 0};
  const Pose X_WB{exp_rotation({0, 0, 3.14159265358979312 / 2}), {1, 2, 3}};  // the lever points to +y
  Vec6 expected;
  expected << 0, 0, -20, -4, 0, 0;
  EXPECT_LT((evaluate_load(load, X_WB, 2).wrench - expected).norm(), 1e-14);
}

TEST(Load, StiffnessIsTheWrenchsDerivative) {
  std::mt19937 generator(1);
  for (const auto frame : {LoadDef::Frame::world, LoadDef::Frame::body}) {
    const LoadDef load = some_load(frame);
    double worst = 0;
    for (int i = 0; i < 50; ++i) {
      const Pose A, B = random_pose(generator, 0.1);
      const auto wrench = [&](const Pose&, const Pose& X) { return VecX(evaluate_load(load, X, 1.7).wrench); };
      const MatX fd = test::twist_difference(wrench, A, B);
      worst = std::max(worst, test::relative_error(evaluate_load(load, B, 1.7).stiffness, fd.rightCols<6>()));
    }
    EXPECT_LT(worst, 1e-10) << "frame " << static_cast<int>(frame);
  }
}

TEST(Load, FollowerIsConstantInTheBodyAndDeadLoadInTheWorld) {
  std::mt19937 generator(2);
  const LoadDef follower = some_load(LoadDef::Frame::body), dead = some_load(LoadDef::Frame::world);
  for (int i = 0; i < 20; ++i) {
    const Pose X = random_pose(generator, 0.1);
    const Vec6 w = evaluate_load(follower, X, 1).wrench;
    const Vec3 moment_B = follower.moment + follower.point.cross(follower.force);
    EXPECT_LT((X.R.transpose() * w.head<3>() - follower.force).norm(), 1e-13);
    EXPECT_LT((X.R.transpose() * w.tail<3>() - moment_B).norm(), 1e-14);
    EXPECT_EQ((evaluate_load(dead, X, 1).wrench.head<3>() - dead.force).norm(), 0);
  }
}

/// A dead force at a point has the potential -f . x: its work round any small loop vanishes, so that the symmetric
/// part alone is left once the moment's own turning, [m]x / 2, is taken out. A follower keeps d f / d w besides.
TEST(Load, OnlyTheDeadForceHasAPotential) {
  LoadDef load = some_load(LoadDef::Frame::world);
  load.moment.setZero();
  std::mt19937 generator(3);
  const Pose X = random_pose(generator, 0.1);
  const auto skew_part = [&] {
    const BodyWrench w = evaluate_load(load, X, 1);
    Mat6 turning = Mat6::Zero();
    turning.block<3, 3>(3, 3) = -skew(w.wrench.tail<3>()) / 2;
    const Mat6 k = w.stiffness - turning;
    return Mat6((k - k.transpose()) / 2).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(skew_part(), 1e-14);
  load.frame = LoadDef::Frame::body;
  EXPECT_GT(skew_part(), 1);
}

TEST(Load, FactorScalesEverything) {
  const LoadDef load = some_load(LoadDef::Frame::body);
  const Pose X{exp_rotation({0.3, -1, 0.2}), {1, 2, 3}};
  const BodyWrench one = evaluate_load(load, X, 1), none = evaluate_load(load, X, 0),
                   minus = evaluate_load(load, X, -4);
  EXPECT_EQ(none.wrench.norm(), 0);
  EXPECT_EQ(none.stiffness.norm(), 0);
  EXPECT_LT((minus.wrench + 4 * one.wrench).norm(), 1e-13);
  EXPECT_LT((minus.stiffness + 4 * one.stiffness).norm(), 1e-13);
}

}  // namespace
}  // namespace genu
