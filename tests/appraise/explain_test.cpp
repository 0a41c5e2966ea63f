// What a scene asks for, in words, and the counts of the system against those of the papers.
#include "genu/appraise/explain.h"

#include <functional>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/scenes.h"

namespace genu {
namespace {

std::string explained(const std::string& text) {
  Diagnostics out;
  const auto scene = parse_scene(text, "scene.toml", out);
  EXPECT_TRUE(scene.has_value()) << test::messages(out);
  return scene ? explain(*scene) : std::string();
}

TEST(Explain, NamesLoadsWeightsJointsAndTime) {
  const std::string text = explained(R"(format = 1
units = { length = "mm", angle = "deg" }
gravity = [0, 0, -9.81]
[body.ground]
fixed = true
[body.arm]
mass = 3
[joint.elbow]
type = "revolute"
parent = "ground"
child = "arm"
axis = [0, 1, 0]
[load.drop]
body = "arm"
force = [0, 0, -5]
[load.follow]
body = "arm"
force = [0, 0, -5]
frame = "body"
[load.pull]
body = "arm"
point = [10, 0, 0]
toward = { body = "ground", point = [0, 0, 90] }
magnitude = 40
scale = { over = "elbow.angle", table = [[0, 1], [90, 2]] }
[load.turn]
on = "elbow.angle"
value = 2
scale = { sine = { amplitude = 1, frequency = 0.5 } }
[[step]]
duration = 2
[[step]]
)");
  for (const char* piece :
       {"drop (dead, on arm)", "follow (follows arm: unsymmetric tangent)",
        "pull (toward a point of ground, 40 N; scaled over elbow.angle)",
        "turn (on elbow.angle, 2 N m; a sine of 0.5 Hz in time)", "weights: arm 3 kg", "holds the other 5",
        "step 1: 1 increment, time 0 to 2 s; free equilibrium", "step 2: 1 increment, time 2 to 3 s",
        "off           rigid contact, cartilage layer, ligaments, bushings: not named"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\nnot in\n" << text;
}

TEST(Explain, SaysNothingOfWhatASceneDoesNotAsk) {
  const std::string text = explained(R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.arm]
[joint.elbow]
type = "revolute"
parent = "ground"
child = "arm"
axis = [0, 1, 0]
[[step]]
)");
  EXPECT_NE(text.find("off           rigid contact, cartilage layer, ligaments, bushings, loads, gravity: not named"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("time"), std::string::npos) << text;
}

std::string torus_knee(const std::function<void(Scene&)>& change = [](Scene&) {}) {
  Diagnostics out;
  auto scene = read_scene(test::dortmans_file(), out);
  EXPECT_TRUE(scene.has_value()) << test::messages(out);
  if (!scene) return {};
  change(*scene);
  return explain(*scene);
}

void expect_said(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << "\"" << piece << "\" is not in\n" << text;
}

TEST(Explain, TheTorusKneeIsSeventeenEquations) {
  const std::string text = torus_knee();
  expect_said(text, "7 + 5 N in all (6B + M + 5N: B = 1, M = 1); room for N <= 5; N = 2: 17 x 17");
  expect_said(text, "reaction of knee.flexion (moment)");
  expect_said(text, "angles flexion about x");
  expect_said(text, "off           cartilage layer, bushings, loads");
}

TEST(Explain, NamesTheToleranceWhereItIsNotTheDefault) {
  EXPECT_EQ(torus_knee().find("tolerance"), std::string::npos);
  expect_said(torus_knee([](Scene& s) { s.solver.tolerance = 1e-8; }),
              "  solver        tolerance 1e-08 in the place of 1e-12\n");
}

TEST(Explain, ArcLengthIsOneUnknownMore) {
  Diagnostics out;
  Scene scene = *read_scene(test::dortmans_file(), out);
  scene.steps[0].arc_length = true;
  const std::string text = explain(scene);
  EXPECT_NE(text.find("by arc length from the last pose"), std::string::npos) << text;
  EXPECT_NE(text.find("N = 2: 18 x 18"), std::string::npos) << text;
}

TEST(Explain, WithoutContactTheSystemIsTheBodysAndTheConstraints) {
  const std::string text = torus_knee([](Scene& s) {
    s.contacts.clear();
    s.steps[0].prescribe.push_back({CoordinateRef{0, 3}, 0, 1e-3});
  });
  expect_said(text, "   8  in all");
  expect_said(text, "knee.x from 0 to 1 mm");
  expect_said(text, "off           rigid contact");
}

}  // namespace
}  // namespace genu
