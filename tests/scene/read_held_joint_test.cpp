#include "genu/core/units.h"
#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kHinge = R"([body.patella]
[joint.hinge]
type = "revolute"
parent = "femur"
child = "patella"
origin = [1, -2, 3]
axis = [0, 3, 4]
stiffness = 0.5
reference = { angle = 10 }
)";
const std::string kWeld = R"([body.patella]
[joint.weld]
type = "fixed"
parent = "femur"
child = "patella"
origin = [1, -2, 3]
)";

void expect_hinge_refused(const std::string& piece, const std::string& replacement, const std::string& key,
                          const std::string& found, const std::string& rule) {
  SCOPED_TRACE(replacement);
  expect_one_error(edited(piece, replacement, kGoodScene + kHinge), key, found, rule);
}

TEST(ReadHeldJoint, RevoluteInSi) {
  const Scene scene = good(kGoodScene + kHinge);
  ASSERT_EQ(scene.joints.size(), 2u);
  const JointDef& joint = scene.joints[1];
  EXPECT_EQ(joint.type, JointDef::Type::revolute);
  EXPECT_EQ(joint.rotations[0].name, "angle");
  EXPECT_LT((joint.rotations[0].axis - Vec3(0, 0.6, 0.8)).norm(), 1e-16);
  EXPECT_DOUBLE_EQ(joint.stiffness, 0.5 / units::kDegree);
  EXPECT_DOUBLE_EQ(joint.reference[0], 10 * units::kDegree);
  EXPECT_EQ(joint.reference[1], 0);
  EXPECT_DOUBLE_EQ(joint.reference[4], -2e-3);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(joint.leaves(i), i == 0) << i;
  // Three axes that make coordinates, each perpendicular to the others.
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(joint.rotations[i].axis.norm(), 1, 1e-15);
    EXPECT_NEAR(joint.rotations[i].axis.dot(joint.rotations[(i + 1) % 3].axis), 0, 1e-15);
  }
}

TEST(ReadHeldJoint, FixedInSi) {
  const JointDef joint = good(kGoodScene + kWeld).joints[1];
  EXPECT_EQ(joint.type, JointDef::Type::fixed);
  EXPECT_DOUBLE_EQ(joint.reference[3], 1e-3);
  EXPECT_EQ(joint.stiffness, 0);
  for (int i = 0; i < 6; ++i) EXPECT_FALSE(joint.leaves(i)) << i;
}

TEST(ReadHeldJoint, Defaults) {
  const std::string bare = edited("origin = [1, -2, 3]\n", "", kGoodScene + kHinge);
  const JointDef joint = good(edited("stiffness = 0.5\nreference = { angle = 10 }\n", "", bare)).joints[1];
  EXPECT_EQ(joint.stiffness, 0);
  EXPECT_EQ(joint.reference, (std::array<double, 6>{}));
}

TEST(ReadHeldJoint, Errors) {
  expect_hinge_refused("axis = [0, 3, 4]", "axis = @[0, 0, 0]", "joint.hinge.axis", "[0, 0, 0]", "a direction");
  expect_hinge_refused("axis = [0, 3, 4]", "axis = @3", "joint.hinge.axis", "3", "must be");
  expect_one_error(edited("[joint.hinge]", "[joint.@hinge]", edited("axis = [0, 3, 4]\n", "", kGoodScene + kHinge)),
                   "joint.hinge.axis", "", "is missing");
  expect_hinge_refused("stiffness = 0.5", "stiffness = @-1", "joint.hinge.stiffness", "-1", "must be >= 0 N m/deg");
  expect_hinge_refused("stiffness = 0.5", "@damping = 0.5", "joint.hinge.damping", "0.5",
                       "only in a scene with [dynamics]");
  expect_hinge_refused("stiffness = 0.5", "@translations = []", "joint.hinge.translations", "[]",
                       "is no key of a revolute joint");
  expect_hinge_refused("{ angle = 10 }", "{ @angel = 10 }", "joint.hinge.reference.angel", "10",
                       "did you mean \"angle\"?");
  expect_hinge_refused("{ angle = 10 }", "{ angle = @\"x\" }", "joint.hinge.reference.angle", "\"x\"", "in deg");
  expect_one_error(edited("origin = [1, -2, 3]", "@axis = [1, 0, 0]", kGoodScene + kWeld), "joint.weld.axis",
                   "[1, 0, 0]", "is no key of a fixed joint");
}

TEST(ReadHeldJoint, WhatIsHeldCannotBePrescribed) {
  const std::string prescribe = "\"knee.flexion\" = [0, 70]";
  const auto refused = [&](const std::string& joint, const std::string& name, const std::string& rule) {
    expect_one_error(edited(prescribe, "@\"" + name + "\" = 0", kGoodScene + joint), "step[1].prescribe." + name, "",
                     rule);
  };
  good(edited(prescribe, "hinge.angle = [0, 3]", kGoodScene + kHinge));
  refused(kHinge, "hinge.x", "joint.hinge is revolute: it holds all coordinates but \"hinge.angle\"");
  refused(kWeld, "weld.angle", "joint.weld is fixed: it holds all its coordinates");
}

TEST(ReadHeldJoint, LoadsMayUseTheAngleAndNothingThatIsHeld) {
  const auto on = [](const std::string& name) { return "[load.turn]\non = " + name + "\n"; };
  const auto over = [](const std::string& name) {
    return "[load.turn]\non = \"knee.x\"\nscale = { over = " + name + ", table = [[0, 1], [90, 2]] }\n";
  };
  const Scene scene = good(kGoodScene + kHinge + on("\"hinge.angle\"")),
              scaled = good(kGoodScene + kHinge + over("\"hinge.angle\""));
  EXPECT_EQ(scene.loads.at(1).coordinate, (CoordinateRef{1, 0}));
  EXPECT_EQ(scaled.loads.at(1).scale.value_or(ScaleDef{}).coordinate, (CoordinateRef{1, 0}));
  const std::string revolute = "joint.hinge is revolute: it holds all coordinates but \"hinge.angle\"";
  expect_one_error(kGoodScene + kHinge + on("@\"hinge.x\""), "load.turn.on", "\"hinge.x\"", revolute);
  expect_one_error(kGoodScene + kHinge + over("@\"hinge.x\""), "load.turn.scale.over", "\"hinge.x\"", revolute);
  const std::string fixed = "joint.weld is fixed: it holds all its coordinates";
  expect_one_error(kGoodScene + kWeld + on("@\"weld.angle\""), "load.turn.on", "\"weld.angle\"", fixed);
  expect_one_error(kGoodScene + kWeld + over("@\"weld.angle\""), "load.turn.scale.over", "\"weld.angle\"", fixed);
}

}  // namespace
}  // namespace genu::scene_test
