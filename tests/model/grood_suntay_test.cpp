// The clinical description of a knee against pure rotations, a joint's own coordinates and its mirror image.
#include "genu/model/grood_suntay.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "genu/model/joint_coordinates.h"
#include "support/wrench_difference.h"

namespace genu {
namespace {

/// x to the right of the body, y forward, z up in both bones.
GroodSuntayDef upright(bool right) {
  GroodSuntayDef def;
  def.right = right;
  return def;
}

Vec6 numbers(const KneeMotion& m) {
  Vec6 out;
  out << m.flexion, m.adduction, m.external_rotation, m.lateral, m.anterior, m.distraction;
  return out;
}

Pose turned(const Vec3& axis, double angle, const Vec3& p = Vec3::Zero()) { return {exp_rotation(angle * axis), p}; }

TEST(GroodSuntay, PureRotationsOfARightKnee) {
  const GroodSuntayDef def = upright(true);
  for (const double angle : {-2.0, -0.5, 0.0, 0.7, 1.5, 3.0}) {
    // Backward: the proximal end of the tibia's axis forward, from z to y.
    EXPECT_NEAR(grood_suntay(def, Pose{}, turned(Vec3::UnitX(), -angle))->flexion, angle, 1e-15);
    // The front from y to x, which is away from the midline of a right knee.
    EXPECT_NEAR(grood_suntay(def, Pose{}, turned(Vec3::UnitZ(), -angle))->external_rotation, angle, 1e-15);
  }
  // The distal end toward the midline: the proximal end of the axis to x.
  EXPECT_NEAR(grood_suntay(def, Pose{}, turned(Vec3::UnitY(), 0.4))->adduction, 0.4, 1e-15);
}

TEST(GroodSuntay, TranslationsAreProjections) {
  const Vec3 p(0.01, 0.02, -0.03);
  Vec6 expected;
  expected << 0, 0, 0, 0.01, 0.02, 0.03;
  EXPECT_LT((numbers(*grood_suntay(upright(true), Pose{}, {Mat3::Identity(), p})) - expected).norm(), 1e-17);
  expected[3] = -0.01;  // x is toward the midline of a left knee
  EXPECT_LT((numbers(*grood_suntay(upright(false), Pose{}, {Mat3::Identity(), p})) - expected).norm(), 1e-17);
  // Flexed by a right angle, the tibia points backward: what lies below the femur is neither drawer nor distraction of
  // the same name.
  const auto flexed = grood_suntay(upright(true), Pose{}, turned(Vec3::UnitX(), -std::numbers::pi / 2, p));
  EXPECT_NEAR(flexed->distraction, -0.02, 1e-16);
  EXPECT_NEAR(flexed->anterior, 0.03, 1e-16);
}

/// Its angles are those of the sequence flexion, adduction, rotation with signs of the side.
TEST(GroodSuntay, MatchesTheJointsOwnSequence) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  double worst = 0;
  for (const bool right : {true, false}) {
    JointDef joint;
    joint.rotations[0].axis = -Vec3::UnitX();
    joint.rotations[1].axis = (right ? 1 : -1) * Vec3::UnitY();
    joint.rotations[2].axis = (right ? -1 : 1) * Vec3::UnitZ();
    const JointCoordinates coordinates(joint);
    for (int i = 0; i < 200; ++i) {
      const JointValues q{3 * unit(generator), 1.4 * unit(generator), 3 * unit(generator), 0, 0, 0};
      const auto motion = grood_suntay(upright(right), Pose{}, coordinates.pose_from(q));
      ASSERT_TRUE(motion.has_value());
      worst = std::max(worst, (numbers(*motion).head<3>() - Vec3(q[0], q[1], q[2])).cwiseAbs().maxCoeff());
    }
  }
  std::printf("worst difference of the angles %.1e rad\n", worst);
  EXPECT_LT(worst, 2e-14);
}

TEST(GroodSuntay, MirroredAndMovedKneesHaveTheSameNumbers) {
  std::mt19937 generator(2);
  const Mat3 mirror = Vec3(-1, 1, 1).asDiagonal();
  const auto mirrored = [&](const Pose& X) { return Pose{mirror * X.R * mirror, mirror * X.p}; };
  const auto mirrored_bone = [&](GroodSuntayDef::Bone bone) {
    for (Vec3* v : {&bone.proximal, &bone.anterior, &bone.origin}) *v = mirror * *v;
    return bone;
  };
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    GroodSuntayDef right = upright(true), left = upright(false);
    for (auto* bone : {&right.femur, &right.tibia}) {
      const Pose axes = test::random_pose(generator, 0.1);
      *bone = {0, axes.R.col(2), axes.R.col(1), axes.p};
    }
    left.femur = mirrored_bone(right.femur);
    left.tibia = mirrored_bone(right.tibia);
    const Pose F = test::random_pose(generator, 0.1), T = test::random_pose(generator, 0.1);
    const Pose move = test::random_pose(generator, 1);
    const Vec6 here = numbers(*grood_suntay(right, F, T));
    worst = std::max(worst, (numbers(*grood_suntay(left, mirrored(F), mirrored(T))) - here).norm());
    const Vec6 there = numbers(*grood_suntay(right, move * F, move * T));
    worst = std::max(worst, (there - here).norm() * std::cos(here[1]));
  }
  EXPECT_LT(worst, 1e-13);
}

TEST(GroodSuntay, RatesAreDerivatives) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    GroodSuntayDef def = upright(i % 2 == 0);
    for (auto* bone : {&def.femur, &def.tibia}) {
      const Pose axes = test::random_pose(generator, 0.1);
      *bone = {0, axes.R.col(2), axes.R.col(1), axes.p};
    }
    const Pose F = test::random_pose(generator, 0.1), T = test::random_pose(generator, 0.1);
    Vec12 twists;
    for (Eigen::Index k = 0; k < 12; ++k) twists[k] = unit(generator);
    const auto moved = [&](double t) {
      return numbers(
          *grood_suntay(def, retract(F, Vec6(t * twists.head<6>())), retract(T, Vec6(t * twists.tail<6>()))));
    };
    const Vec6 exact = numbers(*grood_suntay_rate(def, F, T, twists));
    if (std::abs(numbers(*grood_suntay(def, F, T))[1]) > 1.4) continue;  // rates grow without bound toward 90 deg
    const double h = 1e-4;
    // Flexion and rotation jump by a turn at 180 deg.
    Vec6 one = moved(h) - moved(-h), two = moved(2 * h) - moved(-2 * h);
    for (const Eigen::Index k : {0, 2}) {
      one[k] = std::remainder(one[k], 2 * std::numbers::pi);
      two[k] = std::remainder(two[k], 2 * std::numbers::pi);
    }
    const Vec6 truth = (8 * one - two) / (12 * h);
    worst = std::max(worst, (exact - truth).norm() / exact.norm());
  }
  std::printf("worst relative error of the rates %.1e\n", worst);
  EXPECT_LT(worst, 1e-7);
}

TEST(GroodSuntay, NoFloatingAxisAtARightAngleOfAdduction) {
  const Mat3 right_angle = (Mat3() << 0, 0, 1, 0, 1, 0, -1, 0, 0).finished();
  EXPECT_FALSE(grood_suntay(upright(true), Pose{}, {right_angle, Vec3::Zero()}).has_value());
}

}  // namespace
}  // namespace genu
