#include "genu/core/units.h"
#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kRotations = R"(rotations = ["flexion -z", "adduction x", "rotation y"])";
const std::string kTranslations = R"(translations = ["x", "y", "z"])";

TEST(ReadJoints, ValuesInSi) {
  const Scene scene = good(kGoodScene);
  ASSERT_EQ(scene.joints.size(), 1u);
  const JointDef& joint = scene.joints[0];
  EXPECT_EQ(joint.name, "knee");
  EXPECT_EQ(joint.parent, 0);
  EXPECT_EQ(joint.child, 1);
  EXPECT_EQ(joint.rotations[0].name, "flexion");
  EXPECT_EQ(joint.rotations[0].axis, Vec3(0, 0, -1));
  EXPECT_EQ(joint.rotations[1].axis, Vec3(1, 0, 0));
  EXPECT_EQ(joint.rotations[2].axis, Vec3(0, 1, 0));
  EXPECT_EQ(joint.translations[2], "z");
  EXPECT_DOUBLE_EQ(joint.reference[0], 30 * units::kDegree);
  EXPECT_EQ(joint.reference[1], 0);
  EXPECT_DOUBLE_EQ(joint.reference[4], 2.5e-3);
  EXPECT_EQ(joint.where.line, 10);
  EXPECT_EQ(joint.where.column, 8);
}

TEST(ReadJoints, ReferenceMayBeAbsentAndRotationsMayRepeatAnAxis) {
  const Scene scene =
      good(edited("reference = { flexion = 30, y = 2.5 }\n", "", edited("rotation y\"", "rotation z\"")));
  EXPECT_EQ(scene.joints[0].reference, (std::array<double, 6>{}));
  EXPECT_EQ(scene.joints[0].rotations[2].axis, Vec3::UnitZ());
}

TEST(ReadJoints, Ends) {
  expect_refused("parent = \"tibia\"", "parent = @\"tibbia\"", "joint.knee.parent", "\"tibbia\"",
                 "unknown body; known: \"tibia\", \"femur\"; did you mean \"tibia\"?");
  expect_refused("child = \"femur\"", "child = @3", "joint.knee.child", "3", "must be a string");
  expect_refused("parent = \"tibia\"\nchild = \"femur\"", "parent = \"femur\"\nchild = @\"femur\"", "joint.knee.child",
                 "\"femur\"", "parent and child must be different bodies");
  expect_refused("[joint.knee]\ntype = \"free\"\nparent = \"tibia\"\n", "[joint.@knee]\ntype = \"free\"\n",
                 "joint.knee.parent", "", "is missing");
}

TEST(ReadJoints, ChildOfTwoJoints) {
  const std::string second = R"([joint.hinge]
type = "free"
parent = "tibia"
child = @"femur"
rotations = ["a x", "b y", "c z"]
translations = ["u", "v", "w"]
)";
  expect_one_error(kGoodScene + second, "joint.hinge.child", "\"femur\"", "is already the child of joint.knee");
}

TEST(ReadJoints, FixedChild) {
  const std::string second = R"([body.ground]
fixed = true
[joint.hinge]
type = "free"
parent = "femur"
child = @"ground"
rotations = ["a x", "b y", "c z"]
translations = ["u", "v", "w"]
)";
  expect_one_error(kGoodScene + second, "joint.hinge.child", "\"ground\"", "is fixed");
}

TEST(ReadJoints, Type) {
  expect_refused("type = \"free\"", "type = @\"fre\"", "joint.knee.type", "\"fre\"", "did you mean \"free\"?");
  expect_refused("[joint.knee]\ntype = \"free\"", "[joint.@knee]", "joint.knee.type", "", "is missing");
  expect_refused("type = \"free\"", "type = \"free\"\n@axis = [0, 0, 1]", "joint.knee.axis", "[0, 0, 1]",
                 "is no key of a free joint");
}

TEST(ReadJoints, RotationsAboutAnyDirections) {
  const Scene scene = good(
      edited(kRotations, R"(rotations = ["flexion 0.1 0 -2", "adduction 0.9988 0 0.0499", "rotation 0 1 0.0002"])"));
  const auto& r = scene.joints[0].rotations;
  EXPECT_LT((r[0].axis - Vec3(0.1, 0, -2).normalized()).norm(), 1e-15);
  EXPECT_LT((r[2].axis - Vec3(0, 1, 0.0002).normalized()).norm(), 1e-15);
  EXPECT_LT((r[1].axis - Vec3(0.9988, 0, 0.0499)).norm(), 1e-3);
  EXPECT_LT(std::abs(r[1].axis.dot(r[0].axis)), 1e-15);
  EXPECT_LT(std::abs(r[1].axis.dot(r[2].axis)), 1e-15);
  for (const std::string bad : {"0 0 0", "1 0", "1 0 nan", "1 0 1e400", "1 0 0 0", "1 0 0x", "[1, 0, 0]"})
    expect_refused("\"flexion -z\"", "@\"flexion " + bad + "\"", "joint.knee.rotations[1]", "\"flexion " + bad + "\"",
                   "or \"NAME X Y Z\" with a direction");
  expect_refused("\"adduction x\"", "@\"adduction 1 0 0.1\"", "joint.knee.rotations[2]", "\"adduction 1 0 0.1\"",
                 "must be perpendicular to the rotation before it");
}

TEST(ReadJoints, Rotations) {
  const std::string rule = "must be \"NAME AXIS\"";
  for (const std::string bad : {"flexion", "flexion w", "flexion -z z", "-z", "2x x", "flexion --z", ""}) {
    expect_refused("\"flexion -z\"", "@\"" + bad + "\"", "joint.knee.rotations[1]", "\"" + bad + "\"", rule);
  }
  expect_refused(kRotations, "rotations = @[\"flexion x\"]", "joint.knee.rotations", "[\"flexion x\"]",
                 "must be three rotations");
  expect_refused(kRotations, "rotations = @\"flexion x\"", "joint.knee.rotations", "\"flexion x\"",
                 "must be three rotations");
  expect_refused("\"adduction x\"", "@\"adduction z\"", "joint.knee.rotations[2]", "\"adduction z\"",
                 "neighbours must differ");
  expect_refused("\"rotation y\"", "@\"rotation -x\"", "joint.knee.rotations[3]", "\"rotation -x\"",
                 "neighbours must differ");
  expect_refused("[joint.knee]\ntype = \"free\"\nparent = \"tibia\"\nchild = \"femur\"\n" + kRotations,
                 "[joint.@knee]\ntype = \"free\"\nparent = \"tibia\"\nchild = \"femur\"", "joint.knee.rotations", "",
                 "is missing");
}

TEST(ReadJoints, Translations) {
  expect_refused(kTranslations, "translations = @[\"x\", \"y\"]", "joint.knee.translations", "[\"x\", \"y\"]",
                 "must be three names");
  expect_refused(kTranslations, "translations = [\"x\", @\"a b\", \"z\"]", "joint.knee.translations[2]", "\"a b\"",
                 "a name is");
  expect_refused(kTranslations, "translations = [\"x\", @7, \"z\"]", "joint.knee.translations[2]", "7",
                 "must be a string");
}

TEST(ReadJoints, CoordinateNamesAreDistinct) {
  expect_refused(kTranslations, "translations = [\"x\", @\"x\", \"z\"]", "joint.knee.translations[2]", "\"x\"",
                 "another coordinate of this joint");
  expect_refused(kTranslations, "translations = [@\"flexion\", \"y\", \"z\"]", "joint.knee.translations[1]",
                 "\"flexion\"", "another coordinate of this joint");
  expect_refused("\"rotation y\"", "@\"flexion y\"", "joint.knee.rotations[3]", "\"flexion y\"",
                 "another coordinate of this joint");
}

TEST(ReadJoints, Reference) {
  expect_refused(
      "{ flexion = 30, y = 2.5 }", "{ @flexio = 30 }", "joint.knee.reference.flexio", "30",
      "unknown coordinate; known: \"flexion\", \"adduction\", \"rotation\", \"x\", \"y\", \"z\"; did you mean "
      "\"flexion\"?");
  expect_refused("{ flexion = 30, y = 2.5 }", "{ flexion = @\"30\" }", "joint.knee.reference.flexion", "\"30\"",
                 "must be a number, in deg");
  expect_refused("{ flexion = 30, y = 2.5 }", "{ y = @nan }", "joint.knee.reference.y", "nan", "finite");
  expect_refused("{ flexion = 30, y = 2.5 }", "@[1, 2]", "joint.knee.reference", "[1, 2]", "must be a table");
}

}  // namespace
}  // namespace genu::scene_test
