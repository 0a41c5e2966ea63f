// Loads: closed forms, the derivative against finite differences, and which of them have a potential.
#include "genu/model/load.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/wrench_difference.h"

namespace genu {
namespace {

using test::random_pose;

Load some_load(Load::Kind kind) {
  Load load;
  load.kind = kind;
  load.force = {10, -20, 35};
  load.moment = {0.4, 1.1, -0.7};
  load.p_A = {0.02, -0.05, 0.03};
  load.p_B = {-0.04, 0.03, 0.06};
  load.value = 170;
  return load;
}

constexpr Load::Kind kWithPoints[] = {Load::Kind::dead, Load::Kind::follower, Load::Kind::toward};

TEST(Load, WeightOnALever) {
  PlacedScene scene;
  scene.gravity = Vec3(0, 0, -10);
  scene.bodies.resize(1);
  scene.bodies[0].mass = 2;
  scene.bodies[0].centre_of_mass = {0.2, 0, 0};
  const Pose X_WB{exp_rotation({0, 0, 3.14159265358979312 / 2}), {1, 2, 3}};  // the lever points to +y
  Vec6 expected;
  expected << 0, 0, -20, -4, 0, 0;
  const Vec12 wrench = make_weight(scene, scene.bodies[0], 0).between(X_WB, {}).wrench;
  EXPECT_LT((wrench.head<6>() - expected).norm(), 1e-14);
  EXPECT_EQ(wrench.tail<6>().norm(), 0);
}

TEST(Load, StiffnessIsTheWrenchsDerivative) {
  std::mt19937 generator(1);
  for (const Load::Kind kind : kWithPoints) {
    const Load load = some_load(kind);
    double worst = 0;
    for (int i = 0; i < 50; ++i) {
      const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.5);
      if ((A * load.p_A - B * load.p_B).norm() < 0.1) continue;  // nearer, the differences need a smaller step
      const auto wrench = [&](const Pose& X, const Pose& Y) { return VecX(load.between(X, Y).wrench); };
      const MatX fd = test::twist_difference(wrench, A, B);
      worst = std::max(worst, test::relative_error(load.between(A, B).stiffness, fd));
    }
    EXPECT_LT(worst, kind == Load::Kind::toward ? 1e-7 : 1e-10) << "kind " << static_cast<int>(kind);
  }
}

TEST(Load, StiffnessOnACoordinateIsTheWrenchsDerivative) {
  std::mt19937 generator(4);
  JointDef def;
  def.rotations = {{{"a", Vec3::UnitX()}, {"b", -Vec3::UnitY()}, {"c", Vec3::UnitZ()}}};
  const JointCoordinates joint(def);
  for (int q = 0; q < 6; ++q) {
    Load load;
    load.kind = Load::Kind::coordinate;
    load.coordinate = {0, q};
    load.value = -3;
    double worst = 0;
    for (int i = 0; i < 20; ++i) {
      const Pose A = random_pose(generator, 0.1);
      const Pose B = A * joint.pose_from({0.4 + 0.1 * i, -0.8 + 0.08 * i, 1 - 0.2 * i, 0.01, -0.02, 0.03});
      const JointValues near = joint.coordinates(A.inverse() * B, {});
      const auto wrench = [&](const Pose& X, const Pose& Y) {
        return VecX(load.on_coordinate(joint.evaluate(X, Y, near)).wrench);
      };
      const LoadWrench exact = load.on_coordinate(joint.evaluate(A, B, near));
      worst = std::max(worst, test::relative_error(exact.stiffness, test::twist_difference(wrench, A, B)));
      // Action and reaction: no net force, no net moment about the world's origin.
      EXPECT_LT((exact.wrench.head<3>() + exact.wrench.segment<3>(6)).norm(), 1e-14);
      const Vec3 moment = exact.wrench.segment<3>(3) + A.p.cross(exact.wrench.head<3>()) + exact.wrench.tail<3>() +
                          B.p.cross(exact.wrench.segment<3>(6));
      EXPECT_LT(moment.norm(), 1e-13);
    }
    EXPECT_LT(worst, 1e-9) << "coordinate " << q;
  }
}

TEST(Load, FollowerIsConstantInTheBodyAndDeadLoadInTheWorld) {
  std::mt19937 generator(2);
  const Load follower = some_load(Load::Kind::follower), dead = some_load(Load::Kind::dead);
  for (int i = 0; i < 20; ++i) {
    const Pose X = random_pose(generator, 0.1);
    const Vec12 w = follower.between(X, {}).wrench;
    const Vec3 moment_B = follower.moment + follower.p_A.cross(follower.force);
    EXPECT_LT((X.R.transpose() * w.head<3>() - follower.force).norm(), 1e-13);
    EXPECT_LT((X.R.transpose() * w.segment<3>(3) - moment_B).norm(), 1e-14);
    EXPECT_EQ((dead.between(X, {}).wrench.head<3>() - dead.force).norm(), 0);
  }
}

/// The largest part of the stiffness that no potential has: what is unsymmetric once each body's own turning,
/// [moment]x / 2, is taken out.
double without_potential(const LoadWrench& w) {
  Mat12 k = w.stiffness;
  for (int i = 0; i < 2; ++i) k.block<3, 3>(6 * i + 3, 6 * i + 3) += skew(w.wrench.segment<3>(6 * i + 3)) / 2;
  return (k - k.transpose()).cwiseAbs().maxCoeff() / 2;
}

TEST(Load, ForcesThatAreDeadOrTowardAPointHaveAPotential) {
  std::mt19937 generator(3);
  const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.4);
  Load dead = some_load(Load::Kind::dead);
  EXPECT_GT(without_potential(dead.between(A, B)), 0.1) << "a moment constant in the world has none";
  dead.moment.setZero();
  EXPECT_LT(without_potential(dead.between(A, B)), 1e-14);
  EXPECT_LT(without_potential(some_load(Load::Kind::toward).between(A, B)), 1e-13);
  EXPECT_GT(without_potential(some_load(Load::Kind::follower).between(A, B)), 1);
}

TEST(Load, TowardPullsBothPointsTogether) {
  const Load load = some_load(Load::Kind::toward);
  std::mt19937 generator(5);
  for (int i = 0; i < 20; ++i) {
    const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.2);
    const Vec3 a = A * load.p_A, b = B * load.p_B, pull = 170 * (b - a).normalized();
    const Vec12 w = load.between(A, B).wrench;
    EXPECT_LT((w.head<3>() - pull).norm(), 1e-12);
    EXPECT_LT((w.segment<3>(3) - (a - A.p).cross(pull)).norm(), 1e-12);
    EXPECT_LT((w.segment<3>(6) + pull).norm(), 1e-12);
    EXPECT_LT((w.tail<3>() + (b - B.p).cross(pull)).norm(), 1e-12);
  }
}

TEST(Load, TowardAPointThatIsReachedIsZeroAndNeverNaN) {
  const Load load = some_load(Load::Kind::toward);
  for (const double distance : {0.0, std::numeric_limits<double>::denorm_min(), 1e-200, 9.9e-10}) {
    const LoadWrench w = load.between({}, {Mat3::Identity(), load.p_A - load.p_B + distance * Vec3::UnitX()});
    EXPECT_EQ(w.wrench.norm(), 0) << distance;
    EXPECT_EQ(w.stiffness.norm(), 0) << distance;
  }
  const LoadWrench w = load.between({}, {Mat3::Identity(), load.p_A - load.p_B + 1e-8 * Vec3::UnitX()});
  EXPECT_NEAR(w.wrench.x(), 170, 1e-6);
  EXPECT_TRUE(w.stiffness.allFinite());
}

TEST(Load, LargestForceKnowsArmsAndScales) {
  Load load;
  load.force = {0, 3, 4};
  EXPECT_EQ(load.largest_force(0.1), 5);
  load.moment = {0, 2, 0};
  EXPECT_EQ(load.largest_force(0.1), 20);
  ScaleDef scale;
  scale.table = {{0, 0.5}, {1, -6}};
  std::string why;
  load.scale = LoadScale::make(scale, why);
  EXPECT_EQ(load.largest_force(0.1), 120);
  Load moment;
  moment.kind = Load::Kind::coordinate;
  moment.value = -7;
  EXPECT_EQ(moment.largest_force(0.1), 70);
  moment.coordinate = {0, 3};
  EXPECT_EQ(moment.largest_force(0.1), 7);
}

}  // namespace
}  // namespace genu
