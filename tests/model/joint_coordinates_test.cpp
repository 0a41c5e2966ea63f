// Coordinates of a joint for every sequence of axes: round trips, closed forms, first and second derivatives.
#include "genu/model/joint_coordinates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/wrench_difference.h"

namespace genu {
namespace {

using test::random_pose;

JointDef joint_about(const Vec3& a1, const Vec3& a2, const Vec3& a3) {
  JointDef joint;
  joint.rotations[0].axis = a1;
  joint.rotations[1].axis = a2;
  joint.rotations[2].axis = a3;
  return joint;
}

/// The 12 sequences x 8 choices of sign.
std::vector<JointDef> all_joints() {
  std::vector<JointDef> joints;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int signs = 0; signs < 8 && i != j && j != k; ++signs)
          joints.push_back(joint_about((signs & 1 ? -1 : 1) * Vec3::Unit(i), (signs & 2 ? -1 : 1) * Vec3::Unit(j),
                                       (signs & 4 ? -1 : 1) * Vec3::Unit(k)));
  return joints;
}

JointValues random_values(std::mt19937& generator, double angle) {
  std::uniform_real_distribution<double> unit(-1, 1);
  JointValues q;
  for (int i = 0; i < 6; ++i) q[i] = (i < 3 ? angle : 0.1) * unit(generator);
  return q;
}

double distance(const JointValues& a, const JointValues& b) {
  double worst = 0;
  for (int i = 0; i < 6; ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

/// |cos beta| of the middle angle: 0 at the gimbal pose.
double gimbal_sine(const JointDef& joint, const JointValues& q) {
  const Pose X = JointCoordinates(joint).pose_from({q[0], q[1], q[2], 0, 0, 0});
  return joint.rotations[0].axis.cross(X.R * joint.rotations[2].axis).norm();
}

TEST(JointCoordinates, PoseIsTheProductOfTheRotations) {
  const JointDef joint = joint_about(-Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY());
  const Pose X = JointCoordinates(joint).pose_from({0.7, -0.2, 0.4, 1, 2, 3});
  const Mat3 R = (Eigen::AngleAxisd(-0.7, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.2, Vec3::UnitX()) *
                  Eigen::AngleAxisd(0.4, Vec3::UnitY()))
                     .toRotationMatrix();
  EXPECT_LT((X.R - R).norm(), 1e-15);
  EXPECT_EQ((X.p - Vec3(1, 2, 3)).norm(), 0);
}

TEST(JointCoordinates, RoundTripNearAnyAnglesForEverySequence) {
  std::mt19937 generator(1);
  double worst = 0;
  for (const JointDef& joint : all_joints()) {
    const JointCoordinates coordinates(joint);
    for (int i = 0; i < 40; ++i) {
      const JointValues q = random_values(generator, 20);  // several turns: `near` decides which
      const double sine = gimbal_sine(joint, q);
      if (sine < 0.01) continue;
      JointValues near = q;
      for (int k = 0; k < 3; ++k) near[k] += 0.3 * sine * (i % 2 ? 1 : -1);
      worst = std::max(worst, distance(coordinates.coordinates(coordinates.pose_from(q), near), q) * sine);
    }
  }
  EXPECT_LT(worst, 1e-13);
}

TEST(JointCoordinates, BothTriplesGiveThePose) {
  std::mt19937 generator(2);
  double worst = 0;
  for (const JointDef& joint : all_joints()) {
    const JointCoordinates coordinates(joint);
    const Pose X = random_pose(generator, 0.1);
    std::vector<JointValues> found;
    for (int i = 0; i < 30; ++i) {
      const JointValues q = coordinates.coordinates(X, random_values(generator, 3));
      const Pose back = coordinates.pose_from(q);
      worst = std::max(worst, (back.R - X.R).norm() + (back.p - X.p).norm());
      found.push_back(q);
    }
    const bool two = std::any_of(found.begin(), found.end(), [&](const JointValues& q) {
      return std::abs(std::sin((q[1] - found[0][1]) / 2)) > 1e-6;
    });
    EXPECT_TRUE(two) << "30 random guesses never met the second triple";
  }
  EXPECT_LT(worst, 1e-14);
}

TEST(JointCoordinates, GimbalPoseIsFoundAndNothingIsNaN) {
  std::mt19937 generator(3);
  double worst_pose = 0, worst_far = 0;
  for (const JointDef& joint : all_joints()) {
    const JointCoordinates coordinates(joint);
    const bool euler = std::abs(joint.rotations[0].axis.dot(joint.rotations[2].axis)) > 0.5;
    for (double middle : {0.0, std::numbers::pi / 2, std::numbers::pi, -std::numbers::pi / 2}) {
      JointValues q = random_values(generator, 1);
      q[1] = middle;
      const JointValues near = q;
      q[0] += middle < 1 ? 0.1 : -0.3;
      q[2] += middle < 0 ? 0.25 : -0.2;
      const Pose X = coordinates.pose_from(q);
      const bool gimbal = euler == (std::abs(std::sin(middle)) < 0.5);
      const JointPoint point = coordinates.evaluate(Pose{}, X, near);
      EXPECT_EQ(point.at_gimbal(), gimbal);
      worst_pose = std::max(worst_pose, (coordinates.pose_from(point.values()).R - X.R).norm());
      for (int i = 0; i < 6; ++i) EXPECT_TRUE(point.gradient(i).allFinite() && point.hessian(i).allFinite());
      if (!gimbal) continue;
      // Two numbers with one known sum or difference: the nearest pair shares the change.
      worst_far =
          std::max(worst_far, std::abs(std::abs(point.values()[0] - near[0]) - std::abs(point.values()[2] - near[2])));
      // Pseudo-inverse: J^+ J projects onto what the axes can turn, J J^+ J = J.
      Mat3 axes, rows;
      axes << joint.rotations[0].axis,
          exp_rotation(point.values()[0] * joint.rotations[0].axis) * joint.rotations[1].axis,
          X.R * joint.rotations[2].axis;
      for (int i = 0; i < 3; ++i) rows.row(i) = point.gradient(i).tail<3>();
      EXPECT_LT((axes * rows * axes - axes).norm(), 1e-14);
      EXPECT_LT((rows * axes * rows - rows).norm(), 1e-14);
      EXPECT_LT((rows * axes - (rows * axes).transpose()).norm() + (axes * rows - (axes * rows).transpose()).norm(),
                1e-14);
    }
  }
  EXPECT_LT(worst_pose, 1e-13);
  EXPECT_LT(worst_far, 1e-7);
}

TEST(JointCoordinates, ExtractionStaysExactCloseToTheGimbalPose) {
  std::mt19937 generator(4);
  double worst = 0;
  for (const JointDef& joint : all_joints()) {
    const JointCoordinates coordinates(joint);
    const bool euler = std::abs(joint.rotations[0].axis.dot(joint.rotations[2].axis)) > 0.5;
    for (double off : {1e-3, 1e-7, 1e-10, 1e-13, 1e-14, 1e-15, 1e-17}) {
      JointValues q = random_values(generator, 1);
      q[1] = (euler ? 0 : std::numbers::pi / 2) + off;
      const Pose X = coordinates.pose_from(q);
      worst = std::max(worst, (coordinates.pose_from(coordinates.coordinates(X, {})).R - X.R).norm());
    }
  }
  EXPECT_LT(worst, 1e-13);
}

TEST(JointCoordinates, GimbalSineIsTheAngleBetweenFirstAndLastAxis) {
  const JointDef joint = joint_about(-Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY());
  const JointCoordinates coordinates(joint);
  const JointValues q{0.3, 1.2, -0.4, 0, 0, 0};
  EXPECT_NEAR(coordinates.evaluate(Pose{}, coordinates.pose_from(q), q).gimbal_sine(), std::cos(1.2), 1e-15);
}

TEST(JointCoordinates, OneTurningAxisHasThatAxisAsGradient) {
  const JointCoordinates coordinates(joint_about(-Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()));
  const JointPoint point = coordinates.evaluate(Pose{}, Pose{}, {});
  JointPoint::Gradient flexion, y;
  flexion << 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1;
  y << 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0;
  EXPECT_LT((point.gradient(0) - flexion).norm(), 1e-15);
  EXPECT_LT((point.gradient(4) - y).norm(), 1e-15);
}

TEST(JointCoordinates, GradientIsTheCoordinatesDerivative) {
  std::mt19937 generator(5);
  double worst = 0;
  for (const JointDef& joint : all_joints()) {
    const JointCoordinates coordinates(joint);
    const Pose P = random_pose(generator, 0.1), C = random_pose(generator, 0.1);
    const JointPoint point = coordinates.evaluate(P, C, {});
    if (point.gimbal_sine() < 0.1) continue;
    const auto values = [&](const Pose& X_WP, const Pose& X_WC) -> VecX {
      const JointValues q = coordinates.evaluate(X_WP, X_WC, point.values()).values();
      return Eigen::Map<const Vec6>(q.data());
    };
    const MatX fd = test::twist_difference(values, P, C, 3e-4);
    for (int i = 0; i < 6; ++i) worst = std::max(worst, test::relative_error(point.gradient(i), fd.row(i)));
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(JointCoordinates, HessianIsTheGradientsDerivative) {
  std::mt19937 generator(6);
  double worst = 0;
  int checked = 0;
  for (const JointDef& joint : all_joints())
    for (int trial = 0; trial < 3; ++trial) {
      const JointCoordinates coordinates(joint);
      const Pose P = random_pose(generator, 0.1), C = random_pose(generator, 0.1);
      const JointPoint point = coordinates.evaluate(P, C, {});
      if (point.gimbal_sine() < 0.1) continue;
      ++checked;
      for (int i = 0; i < 6; ++i) {
        const auto gradient = [&](const Pose& X_WP, const Pose& X_WC) -> VecX {
          return coordinates.evaluate(X_WP, X_WC, point.values()).gradient(i).transpose();
        };
        const MatX fd = test::twist_difference(gradient, P, C, 3e-4);
        worst = std::max(worst, test::relative_error(point.hessian(i), fd));
      }
    }
  EXPECT_GT(checked, 200);
  EXPECT_LT(worst, 1e-9);
}

/// Poses of frames with other origins than the bodies' own: the same coordinates, and derivatives to twists about
/// those.
TEST(JointCoordinates, OriginsOfPosesMayStandElsewhere) {
  std::mt19937 generator(8);
  const Vec3 in_parent(0.3, -0.1, 0.2), in_child(-0.2, 0.4, 0.1);
  double worst_value = 0, worst_gradient = 0, worst_hessian = 0;
  for (const JointDef& joint : all_joints()) {
    const JointCoordinates own(joint), moved(joint, in_parent, in_child);
    const Pose P = random_pose(generator, 0.1), C = random_pose(generator, 0.1);
    const Pose to_parent{Mat3::Identity(), in_parent}, to_child{Mat3::Identity(), in_child};
    const JointPoint point = moved.evaluate(P * to_parent, C * to_child, {});
    if (point.gimbal_sine() < 0.1) continue;
    worst_value = std::max(worst_value, distance(point.values(), own.evaluate(P, C, {}).values()));
    const Pose back = moved.pose_from(point.values()), X_PC = (P * to_parent).inverse() * (C * to_child);
    worst_value = std::max(worst_value, (back.R - X_PC.R).norm() + (back.p - X_PC.p).norm());
    const auto values = [&](const Pose& X_WP, const Pose& X_WC) -> VecX {
      const JointValues q = moved.evaluate(X_WP, X_WC, point.values()).values();
      return Eigen::Map<const Vec6>(q.data());
    };
    const MatX fd = test::twist_difference(values, P * to_parent, C * to_child, 3e-4);
    for (int i = 0; i < 6; ++i) {
      worst_gradient = std::max(worst_gradient, test::relative_error(point.gradient(i), fd.row(i)));
      const auto gradient = [&](const Pose& X_WP, const Pose& X_WC) -> VecX {
        return moved.evaluate(X_WP, X_WC, point.values()).gradient(i).transpose();
      };
      const MatX second = test::twist_difference(gradient, P * to_parent, C * to_child, 3e-4);
      worst_hessian = std::max(worst_hessian, test::relative_error(point.hessian(i), second));
    }
  }
  EXPECT_LT(worst_value, 1e-14);
  EXPECT_LT(worst_gradient, 1e-9);
  EXPECT_LT(worst_hessian, 1e-9);
}

/// The gradient does no work on a common motion of both bodies: as a wrench it is an action with its reaction.
TEST(JointCoordinates, CommonMotionChangesNoCoordinate) {
  std::mt19937 generator(7);
  double worst = 0;
  for (const JointDef& joint : all_joints()) {
    const JointCoordinates coordinates(joint);
    const Pose P = random_pose(generator, 0.1), C = random_pose(generator, 0.1), move = random_pose(generator, 1);
    const JointPoint here = coordinates.evaluate(P, C, {}), there = coordinates.evaluate(move * P, move * C, {});
    const Vec3 v(1, -2, 3), w(0.3, 0.8, -0.5);
    Eigen::Matrix<double, 12, 1> twist;
    twist << v + w.cross(P.p), w, v + w.cross(C.p), w;
    for (int i = 0; i < 6; ++i) worst = std::max(worst, std::abs(here.gradient(i) * twist));
    worst = std::max(worst, distance(here.values(), there.values()) * here.gimbal_sine());
  }
  EXPECT_LT(worst, 1e-13);
}

TEST(JointCoordinates, OnlyPerpendicularNeighboursAreValid) {
  for (const JointDef& joint : all_joints()) EXPECT_TRUE(JointCoordinates::is_valid(joint.rotations));
  EXPECT_FALSE(JointCoordinates::is_valid(joint_about(Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY()).rotations));
  EXPECT_FALSE(JointCoordinates::is_valid(joint_about(Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitY()).rotations));
  EXPECT_FALSE(JointCoordinates::is_valid(joint_about(2 * Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()).rotations));
}

}  // namespace
}  // namespace genu
