#include "genu/assemble/opensim_names.h"

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/scenes.h"

namespace genu {
namespace {

Scene two_joints() {
  Diagnostics out;
  const std::string joint = R"(type = "free"
parent = "femur"
rotations = ["flexion -z", "adduction x", "rotation y"]
translations = ["x", "y", "z"]
)";
  const auto scene =
      parse_scene("format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.femur]\nfixed = true\n" +
                      std::string("[body.tibia]\n[body.patella]\n[joint.knee]\nchild = \"tibia\"\n") + joint +
                      "[joint.pf_r]\nchild = \"patella\"\n" + joint + "[[step]]\nincrements = 1\n",
                  "scene.toml", out);
  EXPECT_TRUE(scene.has_value()) << test::messages(out);
  return scene.value_or(Scene{});
}

TEST(OpensimNames, ThePathsLastPartIsTheName) {
  EXPECT_EQ(last_part_of_path("knee_flex_r"), "knee_flex_r");
  EXPECT_EQ(last_part_of_path("/jointset/knee_r/knee_flex_r/value"), "knee_flex_r");
  EXPECT_EQ(last_part_of_path("/jointset/knee_r/knee_flex_r/speed"), "");
}

TEST(OpensimNames, MeanCoordinatesOfTheScene) {
  const Scene scene = two_joints();
  using Found = std::vector<CoordinateRef>;
  EXPECT_EQ(opensim_coordinates(scene, "knee_flex_r"), (Found{{0, 0}}));
  EXPECT_EQ(opensim_coordinates(scene, "/jointset/knee_r/knee_add_r/value"), (Found{{0, 1}}));
  EXPECT_EQ(opensim_coordinates(scene, "knee_tx_l"), (Found{{0, 3}}));
  EXPECT_EQ(opensim_coordinates(scene, "KNEE_rot"), (Found{{0, 2}}));
  EXPECT_EQ(opensim_coordinates(scene, "pf_tz_r"), (Found{{1, 5}})) << "the joint's own name tells the side";
  EXPECT_EQ(opensim_coordinates(scene, "knee_fl_r"), Found{}) << "two letters are too few";
  EXPECT_EQ(opensim_coordinates(scene, "hip_flexion_r"), Found{});
}

}  // namespace
}  // namespace genu
