#include "scene/scene_text.h"

#include <numbers>

namespace genu::scene_test {
namespace {

const std::string kPrescribe = R"(prescribe = { "knee.flexion" = [0, 70] })";

TEST(ReadSteps, Values) {
  const Scene scene = good(kGoodScene +
                           "[[step]]\nprescribe = { \"knee.flexion\" = 70, knee.y = [1, -2.5] }\n[[step]]\n"
                           "load = { push = 0.5 }\nincrements = 1000000\n");
  ASSERT_EQ(scene.steps.size(), 3u);
  const StepDef& first = scene.steps[0];
  ASSERT_EQ(first.prescribe.size(), 1u);
  EXPECT_EQ(first.prescribe[0].coordinate, (CoordinateRef{0, 0}));
  EXPECT_EQ(first.prescribe[0].from, 0);
  EXPECT_DOUBLE_EQ(first.prescribe[0].to, 70 * std::numbers::pi / 180);
  ASSERT_EQ(first.factors.size(), 1u);
  EXPECT_EQ(first.factors[0].load, 0);
  EXPECT_EQ(first.factors[0].from, 0);
  EXPECT_EQ(first.factors[0].to, 1);
  EXPECT_EQ(first.increments, 70);
  const StepDef& second = scene.steps[1];
  ASSERT_EQ(second.prescribe.size(), 2u) << "quoted names and bare ones";
  EXPECT_EQ(second.prescribe[0].from, second.prescribe[0].to);
  EXPECT_EQ(second.prescribe[1].coordinate, (CoordinateRef{0, 4}));
  EXPECT_DOUBLE_EQ(second.prescribe[1].to, -2.5e-3);
  EXPECT_TRUE(second.factors.empty());
  EXPECT_EQ(second.increments, 1);
  EXPECT_TRUE(scene.steps[2].prescribe.empty()) << "free equilibrium";
  EXPECT_EQ(scene.steps[2].factors[0].from, 0.5);
  EXPECT_EQ(scene.steps[2].factors[0].to, 0.5);
  EXPECT_EQ(scene.steps[2].increments, 1000000);
}

TEST(ReadSteps, PrescribeErrors) {
  const auto refused = [](const std::string& entry, const std::string& key, const std::string& found,
                          const std::string& rule) {
    expect_refused(kPrescribe, "prescribe = { " + entry + " }", "step[1].prescribe." + key, found, rule);
  };
  refused("@\"knee.flexon\" = 3", "knee.flexon", "", "did you mean \"knee.flexion\"?");
  refused("@\"hip.flexion\" = 3", "hip.flexion", "", "unknown coordinate");
  refused("@flexion = 3", "flexion", "", "unknown coordinate");
  refused("\"knee.flexion\" = @[1, 2, 3]", "knee.flexion", "[1, 2, 3]", "must be [from, to] or one number, in deg");
  refused("\"knee.x\" = @\"1\"", "knee.x", "\"1\"", "must be [from, to] or one number, in mm");
  refused("\"knee.x\" = [0, @nan]", "knee.x[2]", "nan", "finite");
  refused("\"knee.x\" = @inf", "knee.x", "inf", "finite");
  refused("\"knee.x\" = 1, knee.@x = 2", "knee.x", "", "is prescribed twice");
  expect_refused(kPrescribe, "prescribe = @3", "step[1].prescribe", "3", "must be a table");
}

TEST(ReadSteps, LoadErrors) {
  expect_refused("load = { push", "load = { @push_ ", "step[1].load.push_", "[0, 1]",
                 "unknown load; known: \"push\"; did you mean \"push\"?");
  expect_refused("push = [0, 1]", "push = @[0]", "step[1].load.push", "[0]", "must be [from, to] or one number");
  expect_refused("load = { push = [0, 1] }", "load = @1", "step[1].load", "1", "must be a table");
}

TEST(ReadSteps, LoadsThatDrive) {
  const std::string loads = "load = { push = [0, 1] }\n",
                    other = "[load.other]\nbody = \"femur\"\nforce = [1, 0, 0]\n\n[[step]]";
  const std::string scene = edited("[[step]]", other, edited(loads, ""));
  const auto drivers = [&](const std::string& drive) {
    return good(edited(kPrescribe, kPrescribe + "\ndrive = " + drive, scene)).steps.at(0).prescribe.at(0).drivers;
  };
  EXPECT_EQ(drivers("\"push\""), std::vector<int>{0});
  EXPECT_EQ(drivers("[\"other\", \"push\"]"), (std::vector<int>{1, 0}));
  EXPECT_EQ(drivers("{ \"knee.flexion\" = \"other\" }"), std::vector<int>{1});
  EXPECT_EQ(drivers("{ knee.flexion = [\"push\"] }"), std::vector<int>{0});
}

TEST(ReadSteps, DriveErrors) {
  const auto refused = [](const std::string& drive, const std::string& key, const std::string& found,
                          const std::string& rule) {
    expect_refused("load = { push = [0, 1] }", drive, "step[1]." + key, found, rule);
  };
  refused("drive = @\"pull\"", "drive", "\"pull\"", "unknown load; known: \"push\"");
  refused("drive = @3", "drive", "3", "must be");
  refused("drive = @[]", "drive", "[]", "must name a load");
  refused("drive = [\"push\", @\"push\"]", "drive[2]", "\"push\"", "drives a coordinate already");
  refused("drive = { @\"knee.rotation\" = \"push\" }", "drive.knee.rotation", "", "is not prescribed in this step");
  refused("drive = { @\"knee.flexon\" = \"push\" }", "drive.knee.flexon", "", "did you mean \"knee.flexion\"?");
  refused("load = { push = 1 }\ndrive = @\"push\"", "drive", "\"push\"", "has a factor in `load` of this step");
  refused("control = \"arc_length\"\n@drive = \"push\"", "drive", "", "is an unknown of every pose");
  expect_refused(kPrescribe + "\nload = { push = [0, 1] }",
                 "prescribe = { \"knee.flexion\" = [0, 70], \"knee.x\" = 0 }\ndrive = @\"push\"", "step[1].drive",
                 "\"push\"", "which of 2 prescribed coordinates?");
}

TEST(ReadSteps, Increments) {
  for (const std::string bad : {"0", "-5", "1000001", "70.0", "\"70\"", "true", "[70]"}) {
    expect_refused("increments = 70", "increments = @" + bad, "step[1].increments", bad,
                   "must be an integer from 1 to 1000000");
  }
  expect_refused("increments = 70", "@increment = 70", "step[1].increment", "70", "did you mean \"increments\"?");
}

TEST(ReadSteps, Duration) {
  EXPECT_EQ(good(kGoodScene).steps.at(0).duration, 1) << "s";
  EXPECT_EQ(good(edited("increments = 70", "duration = 0.25")).steps.at(0).duration, 0.25);
  for (const std::string bad : {"0", "-1"})
    expect_refused("increments = 70", "duration = @" + bad, "step[1].duration", bad, "must be > 0 s");
  expect_refused("increments = 70", "duration = @\"1 s\"", "step[1].duration", "\"1 s\"", "must be a number, in s");
}

TEST(ReadSteps, Form) {
  const std::string head = kGoodScene.substr(0, kGoodScene.find("[[step]]"));
  expect_one_error(head + "@[step]\nincrements = 3\n", "step", "a table", "steps are written [[step]]");
  expect_one_error("@" + head, "step", "", "a scene needs at least one [[step]]");
}

TEST(ReadSteps, OneMovingBodyKeepsAFreedom) {
  const auto text = [](const std::string& coordinates) {
    return edited(kPrescribe, "@prescribe = { " + coordinates + " }");
  };
  const std::string four = "\"knee.flexion\" = 0, \"knee.adduction\" = 0, \"knee.x\" = 0, \"knee.y\" = 0";
  good(unmarked(text(four)).text);  // M + N = 4 + 1 = 5
  expect_one_error(text(four + ", \"knee.z\" = 0"), "step[1].prescribe", "", "M + N = 5 + 1 = 6, at most 5");
}

TEST(ReadSteps, SeveralMovingBodiesKeepAFreedom) {
  const std::string patella = R"([body.patella]
[joint.pf]
type = "free"
parent = "femur"
child = "patella"
rotations = ["a x", "b y", "c z"]
translations = ["u", "v", "w"]
)";
  const std::string ten = R"("knee.flexion" = 0, "knee.adduction" = 0, "knee.rotation" = 0, "knee.x" = 0,
 "knee.y" = 0, "knee.z" = 0, "pf.a" = 0, "pf.b" = 0, "pf.c" = 0, "pf.u" = 0)";
  const auto text = [&](const std::string& coordinates) {
    std::string flat = coordinates;
    std::erase(flat, '\n');
    return edited(kPrescribe, "@prescribe = { " + flat + " }", kGoodScene + patella);
  };
  good(unmarked(text(ten)).text);
  expect_one_error(text(ten + ", \"pf.v\" = 0"), "step[1].prescribe", "", "M + N = 11 + 1 = 12, at most 11");
}

TEST(ReadSteps, WhatJointsHoldCounts) {
  const std::string chain = R"([body.shank]
[body.foot]
[joint.hinge]
type = "revolute"
parent = "femur"
child = "shank"
axis = [0, 0, 1]
[joint.weld]
type = "fixed"
parent = "shank"
child = "foot"
)";
  const auto text = [&](const std::string& coordinates) {
    return edited(kPrescribe, "@prescribe = { " + coordinates + " }", kGoodScene + chain);
  };
  const std::string five = "\"knee.flexion\" = 0, \"knee.x\" = 0, \"knee.y\" = 0, \"knee.z\" = 0, \"hinge.angle\" = 0";
  good(unmarked(text(five)).text);
  expect_one_error(text(five + ", \"knee.rotation\" = 0"), "step[1].prescribe", "",
                   "11 coordinates that joints hold, prescribed coordinates and rigid contact pairs M + N = 17 + 1 = "
                   "18, at most 17");
}

TEST(ReadSteps, PrescribedValuesAreIndependent) {
  const std::string combinations = R"([combination.sum]
terms = { "knee.flexion" = 1, "knee.rotation" = 2 }
[combination.difference]
terms = { knee.flexion = 3, knee.rotation = -6 }
)";
  const auto text = [&](const std::string& entries) {
    return edited(kPrescribe, "prescribe = { " + entries + " }", kGoodScene + combinations);
  };
  good(text("sum = 0, difference = 0"));
  good(text("\"knee.flexion\" = 0, difference = 0"));
  const std::string rule = "follows from what is prescribed before it";
  expect_one_error(text("\"knee.flexion\" = 0, \"knee.rotation\" = 0, @sum = 0"), "step[1].prescribe.sum", "", rule);
  expect_one_error(text("sum = 0, difference = 0, knee.@flexion = 0"), "step[1].prescribe.knee.flexion", "", rule);
  expect_one_error(text("sum = 0, @summ = 0"), "step[1].prescribe.summ", "", "did you mean \"sum\"?");
}

}  // namespace
}  // namespace genu::scene_test
