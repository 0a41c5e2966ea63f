#include "genu/osim/path_plan.h"

#include <gtest/gtest.h>

#include "osim/osim_support.h"

namespace genu::test {
namespace {

struct Leg {
  explicit Leg(const std::string& text, const osim::CoordinateValues& values = {}) : model(model_of(text)) {
    Diagnostics out;
    skeleton = osim::Skeleton::build(model, {"knee_r"}, values, out);
    EXPECT_TRUE(skeleton.has_value());
  }
  osim::PathPlan muscle(int index) const {
    return osim::plan_path(model, *skeleton, model.muscles[static_cast<std::size_t>(index)].path);
  }
  osim::Model model;
  std::optional<osim::Skeleton> skeleton;
};

TEST(PathPlan, PointsAreThoseOfRigidBodies) {
  const Leg leg(leg_text());
  const osim::PathPlan plan = osim::plan_path(leg.model, *leg.skeleton, leg.model.ligaments[0].path);
  ASSERT_EQ(plan.points.size(), 2u);
  EXPECT_TRUE(plan.crosses());
  EXPECT_LT((plan.points[0].point - Vec3(0, 0, 0.035)).norm(), 1e-15);  // in the knee's frame of the femur
  EXPECT_EQ(plan.points[1].point, Vec3(-0.01, -0.07, 0.035));
  EXPECT_FALSE(leg.muscle(2).crosses());  // psoas: pelvis and femur are one body
}

TEST(PathPlan, ConditionalPointsAreAsAtThePose) {
  const osim::PathPlan bent = Leg(leg_text(), {{"knee_flex_r", 1}}).muscle(0);
  const osim::PathPlan straight = Leg(leg_text(), {{"knee_flex_r", -0.1}}).muscle(0);
  EXPECT_EQ(bent.points.size(), 3u);
  EXPECT_EQ(straight.points.size(), 2u);
  ASSERT_EQ(bent.remarks.size(), 1u);
  EXPECT_TRUE(contains(bent.remarks[0], "comes and goes with knee_flex_r"));
}

TEST(PathPlan, MovingPointsAreAsAtThePose) {
  std::string text = leg_text();
  const std::string from =
      "<PathPoint name=\"c\"><socket_parent_frame>/bodyset/tibia_r</socket_parent_frame><location>-0.01 -0.08 "
      "0</location></PathPoint>";
  text.replace(text.find(from), from.size(),
               "<MovingPathPoint name=\"c\"><socket_parent_frame>/bodyset/tibia_r</socket_parent_frame>"
               "<socket_x_coordinate>/jointset/hip_r/hip_flex_r</socket_x_coordinate>"
               "<socket_y_coordinate>/jointset/hip_r/hip_flex_r</socket_y_coordinate>"
               "<socket_z_coordinate>/jointset/hip_r/hip_flex_r</socket_z_coordinate>"
               "<x_location><LinearFunction><coefficients>0.1 0.01</coefficients></LinearFunction></x_location>"
               "<y_location><Constant><value>-0.08</value></Constant></y_location>"
               "<z_location><Constant><value>0</value></Constant></z_location></MovingPathPoint>");
  const osim::PathPlan plan = Leg(text, {{"hip_flex_r", 0.2}}).muscle(0);
  EXPECT_LT((plan.points.back().point - Vec3(0.03, -0.08, 0)).norm(), 1e-15);
  EXPECT_EQ(plan.remarks.size(), 1u);  // of the conditional point alone: the hip is frozen
  const auto replaced = [](std::string in, const std::string& a, const std::string& b) {
    return in.replace(in.find(a), a.size(), b);
  };
  text = replaced(text, "<socket_z_coordinate>/jointset/hip_r/hip_flex_r",
                  "<socket_z_coordinate>/jointset/knee_r/knee_flex_r");
  EXPECT_EQ(Leg(text).muscle(0).remarks.size(), 1u);  // it does not depend on that
  text = replaced(text, "<z_location><Constant><value>0</value></Constant>",
                  "<z_location><LinearFunction><coefficients>0.1 0</coefficients></LinearFunction>");
  ASSERT_EQ(Leg(text).muscle(0).remarks.size(), 2u);
  EXPECT_TRUE(contains(Leg(text).muscle(0).remarks[1], "WARNING: its point c moves with knee_flex_r"));
}

/// Two spheres along the LCL, which runs from y = -400 to -470 mm of the femur at this pose.
TEST(PathPlan, SeveralWrapsBetweenTwoPointsComeInTheOrderOfTheLine) {
  const auto with = [](const std::string& first, const std::string& second) {
    const auto sphere = [](const std::string& name, const std::string& y) {
      return "<WrapSphere name=\"" + name + "\"><translation>-0.003 " + y +
             " 0.035</translation><radius>0.006</radius></WrapSphere>";
    };
    const auto wrap = [](const std::string& name) {
      return "<PathWrap name=\"w\"><wrap_object>" + name + "</wrap_object></PathWrap>";
    };
    const std::string cylinder = "<WrapCylinder name=\"condyles\">", points = "</PathPointSet>";
    std::string text = leg_with(cylinder, sphere("upper", "-0.42") + sphere("lower", "-0.425") + cylinder);
    return text.insert(text.find(points, text.find("LCL1-P2")) + points.size(),
                       "<PathWrapSet><objects>" + wrap(first) + wrap(second) + "</objects></PathWrapSet>");
  };
  for (const std::string& text : {with("upper", "lower"), with("lower", "upper")}) {
    const Leg leg(text);
    const osim::PathPlan plan = osim::plan_path(leg.model, *leg.skeleton, leg.model.ligaments[0].path);
    ASSERT_EQ(plan.wraps.size(), 2u);
    EXPECT_EQ(plan.wraps[0].object->name, "upper");
    EXPECT_LT(plan.wraps[0].along, plan.wraps[1].along);
    // by hand, where the line passes the first centre: its foot on the line, over the line's length squared
    const Pose X_femur_tibia = leg.skeleton->rigid_in_ground(0).inverse() * leg.skeleton->rigid_in_ground(1);
    const Vec3 from(0, 0, 0.035), line = X_femur_tibia * Vec3(-0.01, -0.07, 0.035) - from;
    EXPECT_NEAR(plan.wraps[0].along, (Vec3(-0.003, -0.02, 0.035) - from).dot(line) / line.squaredNorm(), 1e-6);
    ASSERT_EQ(plan.remarks.size(), 1u);
    EXPECT_TRUE(contains(plan.remarks[0], "wraps round upper, lower in the order"));
  }
}

/// From the femur round the tibia and back: it pulls at both.
TEST(PathPlan, ALoopRoundAnotherBodyCrosses) {
  const std::string tibia = "<socket_parent_frame>/bodyset/tibia_r", femur = "<socket_parent_frame>/bodyset/femur_r";
  const Leg loop(leg_with(tibia, femur, "MCL1-P2"));
  const osim::PathPlan plan = osim::plan_path(loop.model, *loop.skeleton, loop.model.ligaments[1].path);
  EXPECT_EQ(plan.points[0].rigid, plan.points[1].rigid);
  EXPECT_TRUE(plan.crosses());
  const Leg inside(leg_with(tibia, femur, "LCL1-P2"));
  EXPECT_FALSE(osim::plan_path(inside.model, *inside.skeleton, inside.model.ligaments[0].path).crosses());
}

TEST(PathPlan, WrapsComeBetweenThePointsNearestToThem) {
  std::string text = leg_text();  // the hamstring wraps round the condyles, which its first part passes
  const std::string after = "</PathPointSet>";
  const std::size_t at = text.find(after, text.find("name=\"hamstring\"")) + after.size();
  const auto with = [&](const std::string& range) {
    return text.substr(0, at) +
           "<PathWrapSet><objects><PathWrap name=\"w\"><wrap_object>condyles</wrap_object><range>" + range +
           "</range></PathWrap></objects></PathWrapSet>" + text.substr(at);
  };
  const osim::CoordinateValues bent = {{"knee_flex_r", 0.5}};
  ASSERT_EQ(Leg(with("-1 -1"), bent).muscle(0).wraps.size(), 1u);
  EXPECT_EQ(Leg(with("-1 -1"), bent).muscle(0).wraps[0].after, 0u);
  EXPECT_EQ(Leg(with("2 3"), bent).muscle(0).wraps[0].after, 1u);
  EXPECT_TRUE(Leg(with("3 3"), bent).muscle(0).wraps.empty());
}

TEST(PathPlan, ThatNamesNothingIsAProblem) {
  const Leg lost(leg_with("<wrap_object>condyles", "<wrap_object>condylus"));
  EXPECT_TRUE(contains(lost.muscle(1).problem, "wraps round condylus"));
  const Leg alike(leg_with("\"ring\"", "\"condyles\""));
  EXPECT_EQ(alike.muscle(1).wraps.size(), 1u);
  EXPECT_TRUE(contains(alike.muscle(1).remarks.at(0), "condyles: the first is taken, of /bodyset/femur_r"));
  const Leg inactive(leg_with("<wrap_object>condyles", "<wrap_object>ring"));
  EXPECT_TRUE(inactive.muscle(1).problem.empty());
  EXPECT_TRUE(inactive.muscle(1).wraps.empty());
  EXPECT_TRUE(contains(inactive.muscle(1).remarks.at(0), "ring is not active"));
}

}  // namespace
}  // namespace genu::test
