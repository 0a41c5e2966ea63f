#include "genu/run/explain.h"

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "run/scenes.h"

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
  for (const char* piece : {"drop (dead, on arm)", "follow (follows arm: unsymmetric tangent)",
                            "pull (toward a point of ground, 40 N; scaled over elbow.angle)",
                            "turn (on elbow.angle, 2 N m; a sine of 0.5 Hz in time)", "weights: arm 3 kg",
                            "holds the other 5", "step 1: 1 increment, time 0 to 2 s; free equilibrium",
                            "step 2: 1 increment, time 2 to 3 s", "off           rigid contact, ligaments: not named"})
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
  EXPECT_NE(text.find("off           rigid contact, ligaments, loads, gravity: not named"), std::string::npos) << text;
  EXPECT_EQ(text.find("time"), std::string::npos) << text;
}

}  // namespace
}  // namespace genu
