#include "genu/osim/skeleton.h"

#include <gtest/gtest.h>

#include "genu/osim/property_reader.h"
#include "osim/osim_support.h"

namespace genu::test {
namespace {

using osim::Skeleton;

Mat3 about_x(double a) { return Eigen::AngleAxisd(a, Vec3::UnitX()).toRotationMatrix(); }
Mat3 about_z(double a) { return Eigen::AngleAxisd(a, Vec3::UnitZ()).toRotationMatrix(); }

Skeleton built(const osim::Model& model, const std::vector<std::string>& joints,
               const osim::CoordinateValues& values = {}) {
  Diagnostics out;
  auto skeleton = Skeleton::build(model, joints, values, out);
  EXPECT_FALSE(out.has_errors()) << to_string(out.items().front());
  EXPECT_TRUE(skeleton.has_value());
  return *skeleton;
}

std::string refused(const osim::Model& model, const std::vector<std::string>& joints) {
  Diagnostics out;
  EXPECT_FALSE(Skeleton::build(model, joints, {}, out).has_value());
  EXPECT_TRUE(out.has_errors());
  return out.items().empty() ? "" : to_string(out.items().front());
}

void expect_near(const Pose& a, const Pose& b) {
  EXPECT_LT((a.R - b.R).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((a.p - b.p).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Skeleton, FreezesWhatIsNotAskedFor) {
  const osim::Model model = leg();
  const Skeleton s = built(model, {"knee_r"});
  ASSERT_EQ(s.bodies().size(), 2u);
  EXPECT_EQ(s.body_name(s.bodies()[0].named_after), "femur_r");
  EXPECT_TRUE(s.bodies()[0].fixed);
  EXPECT_EQ(s.bodies()[1].bodies, (std::vector<int>{2, 3}));  // tibia and foot
  ASSERT_EQ(s.joints().size(), 1u);
  const osim::MovingJoint& knee = s.joints()[0];
  EXPECT_EQ(knee.kind, osim::MovingJoint::Kind::free);
  EXPECT_EQ(knee.rotations[0].axis, 2);
  EXPECT_TRUE(knee.rotations[0].negative);
  EXPECT_EQ(knee.rotations[1].axis, 0);
  EXPECT_FALSE(knee.rotations[1].negative);
  EXPECT_EQ(knee.translations, (std::array<std::string, 3>{"knee_tx_r", "knee_ty_r", "knee_tz_r"}));
}

/// By hand: pelvis at y = 1, hip 0.1 below and 0.08 to the side, knee 0.4 below that, in the femur's frame.
TEST(Skeleton, PlacesBodiesAsTheFileSays) {
  const osim::Model model = leg();
  const Skeleton s = built(model, {"knee_r"}, {{"hip_flex_r", 1.0}, {"pelvis_rx", 0.25}});
  const Pose X_ground_pelvis{about_x(0.25), Vec3(0, 1, 0)};
  const Pose X_pelvis_femur{about_z(1), Vec3(0.02, -0.1, 0.08)};  // its spline has 0.01 at 1, times 2
  const Pose X_femur_knee{Mat3::Identity(), Vec3(0, -0.4, 0)};
  expect_near(s.rigid_in_ground(0), X_ground_pelvis * X_pelvis_femur * X_femur_knee);
  const Pose X_knee_tibia{about_z(-0.1), Vec3(0.001, 0, 0)};
  expect_near(s.rigid_in_ground(1), s.rigid_in_ground(0) * X_knee_tibia);
  expect_near(s.in_rigid(1), X_femur_knee.inverse());
}

TEST(Skeleton, OrdersRotationsAsTheFileDoes) {
  const osim::Model model = leg();
  const osim::CoordinateValues values = {{"knee_flex_r", 0.4}, {"knee_add_r", 0.2}, {"knee_rot_r", -0.3},
                                         {"knee_tx_r", 0.01},  {"knee_ty_r", 0.02}, {"knee_tz_r", 0.03}};
  const Skeleton s = built(model, {"knee_r"}, values);
  const Pose X = s.rigid_in_ground(0).inverse() * s.rigid_in_ground(1);
  const Mat3 R = about_z(-0.4) * about_x(0.2) * Eigen::AngleAxisd(-0.3, Vec3::UnitY()).toRotationMatrix();
  expect_near(X, {R, Vec3(0.01, 0.02, 0.03)});
}

TEST(Skeleton, FrozenCoordinatesFollowTheirCouplers) {
  const osim::Model model = leg();
  EXPECT_DOUBLE_EQ(built(model, {"knee_r"}, {{"hip_flex_r", 0.6}}).value("ankle_angle_r"), 0.5);
  EXPECT_DOUBLE_EQ(built(model, {"knee_r"}, {{"hip_flex_r", 0.6}, {"ankle_angle_r", 0.1}}).value("ankle_angle_r"), 0.1);
}

/// The pelvis drives the hip, and that the ankle, in whatever order the file has them.
TEST(Skeleton, CouplersDriveEachOther) {
  const std::string chain = leg_with("</objects>\n    </ConstraintSet>",
                                     leg_coupler("pelvis_rx", "hip_flex_r") + "</objects></ConstraintSet>");
  const osim::Model model = model_of(chain);
  const Skeleton s = built(model, {"knee_r"}, {{"pelvis_rx", 0.4}});
  EXPECT_DOUBLE_EQ(s.value("hip_flex_r"), 0.9);
  EXPECT_DOUBLE_EQ(s.value("ankle_angle_r"), 0.2 + 0.5 * 0.9);
}

/// A revolute joint of a scene has the child's axes along the parent's at angle 0, whatever the frames of the pin.
TEST(Skeleton, PinsBecomeRevoluteJoints) {
  const osim::Model model = leg();
  for (const double angle : {0.0, 0.2, -1.1}) {
    const Skeleton s = built(model, {"knee_r", "ankle_r"}, {{"ankle_angle_r", angle}});
    ASSERT_EQ(s.joints().size(), 2u);
    const osim::MovingJoint& ankle = s.joints()[1];
    EXPECT_EQ(ankle.kind, osim::MovingJoint::Kind::revolute);
    EXPECT_EQ(ankle.angle, "ankle_angle_r");
    EXPECT_LT((ankle.axis - about_x(0.3) * Vec3::UnitZ()).norm(), 1e-15);
    const Pose of_scene{exp_rotation(angle * ankle.axis), ankle.origin};
    expect_near(s.rigid_in_ground(ankle.parent).inverse() * s.rigid_in_ground(ankle.child), of_scene);
    // By hand: where the foot is.
    const Pose X_tibia_foot = Pose{about_x(0.3), Vec3(0, -0.4, 0)} * Pose{about_z(angle), Vec3::Zero()} *
                              Pose{about_x(0.3), Vec3(0, 0.05, 0)}.inverse();
    expect_near(s.rigid_in_ground(ankle.parent).inverse() * s.rigid_in_ground(ankle.child) * s.in_rigid(3),
                X_tibia_foot);
  }
}

TEST(Skeleton, AddsMassesOfFrozenBodies) {
  const osim::Model model = leg();
  const Skeleton s = built(model, {"knee_r"}, {{"ankle_angle_r", 0}});
  const osim::RigidBody& shank = s.bodies()[1];
  EXPECT_DOUBLE_EQ(shank.mass, 4);
  const Vec3 foot = Vec3(0, -0.4, 0) + about_x(0.3) * (about_x(-0.3) * (Vec3(0.1, 0, 0) - Vec3(0, 0.05, 0)));
  EXPECT_LT((shank.centre - (3 * Vec3(0, -0.2, 0) + foot) / 4).norm(), 1e-15);
  // Steiner, about z: two masses and their distances from the common centre.
  const double apart = (foot - Vec3(0, -0.2, 0)).squaredNorm();
  EXPECT_NEAR(shank.inertia(2, 2), 0.04 + 0.004 + 3.0 / 4 * apart, 1e-15);
}

TEST(Skeleton, WithoutNamesTakesFreeJointsBetweenBodies) {
  const osim::Model model = leg();
  const Skeleton s = built(model, {});
  ASSERT_EQ(s.joints().size(), 1u);
  EXPECT_TRUE(s.moves_joint("knee_r"));
  EXPECT_TRUE(s.moves("knee_rot_r"));
  EXPECT_FALSE(s.moves("hip_flex_r"));
}

TEST(Skeleton, RefusesJointsThatASceneCannotHave) {
  EXPECT_TRUE(contains(refused(leg(), {"kneer"}), "did you mean \"knee_r\"?"));
  EXPECT_TRUE(contains(refused(leg(), {"hip_r"}), "can be no free joint (translation 1 is not its coordinate"));
  const std::string half = leg_with("<coefficients>-1 0", "<coefficients>-0.5 0");
  EXPECT_TRUE(
      contains(refused(model_of(half), {"knee_r"}), "rotation 1 is not its coordinate knee_flex_r or minus that"));
  const std::string oblique = leg_with("<axis>1 0 0", "<axis>1 1 0", "<coordinates>knee_add_r");
  EXPECT_TRUE(contains(refused(model_of(oblique), {"knee_r"}), "the axis of rotation 2 is none of x, y, z"));
  const std::string against = leg_with("<coefficients>1 0", "<coefficients>-1 0", "<coordinates>knee_tz_r");
  EXPECT_TRUE(contains(refused(model_of(against), {"knee_r"}), "translation 3 goes against its axis"));
}

TEST(Skeleton, RefusesLoops) {
  const std::string twice = leg_with("<socket_child_frame>ankle_in_foot", "<socket_child_frame>/bodyset/tibia_r");
  EXPECT_TRUE(contains(refused(model_of(twice), {"knee_r"}), "is moved by the joint knee_r too"));
}

TEST(BodyFixedXyz, TurnsAboutTheMovingAxes) {
  const Vec3 a(0.3, -0.5, 0.8);
  const Mat3 R = about_x(0.3) * Eigen::AngleAxisd(-0.5, Vec3::UnitY()).toRotationMatrix() * about_z(0.8);
  EXPECT_LT((osim::body_fixed_xyz(a) - R).cwiseAbs().maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace genu::test
