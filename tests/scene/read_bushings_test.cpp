// Bushings of a scene: frames, numbers, matrices, and what is refused.
#include "scene/scene_text.h"

#include "genu/scene/read_parts.h"

namespace genu::scene_test {
namespace {

const std::string kPlace = "[load.push]";
const std::string kBushing =
    "[bushing.pad]\nfrom = { body = \"tibia\", origin = [1, 2, 3], z_axis = [1, 0, 0] }\nto = { body = \"femur\" }\n"
    "stiffness = [10, 20, 30]\nrotation_stiffness = [1, 2, 3]\n";

BushingDef bushing_of(const std::string& text) { return good(edited(kPlace, text + kPlace)).bushings.at(0); }

void expect_bushing_refused(const std::string& before, const std::string& after, const std::string& key,
                            const std::string& found, const std::string& rule) {
  std::string text = kBushing;
  text.replace(text.find(before), before.size(), after);
  expect_refused(kPlace, text + kPlace, "bushing.pad" + key, found, rule);
}

TEST(ReadBushings, Values) {
  const BushingDef b = bushing_of(kBushing);
  EXPECT_EQ(b.name, "pad");
  EXPECT_EQ(b.from.body, 0);
  EXPECT_EQ(b.to.body, 1);
  EXPECT_TRUE(b.from.placement.p.isApprox(Vec3(1e-3, 2e-3, 3e-3), 1e-15));
  EXPECT_TRUE(b.from.placement.R.col(2).isApprox(Vec3(1, 0, 0), 1e-15));
  EXPECT_TRUE(b.stiffness.isApprox(Vec3(1e4, 2e4, 3e4), 1e-15)) << "N/mm";
  EXPECT_FALSE(b.matrix.has_value());
}

TEST(ReadBushings, AFrameWithoutAPlaceCoincidesAtTheReferencePose) {
  const Scene scene = good(edited(kPlace, kBushing + kPlace));
  const BushingDef& b = scene.bushings.at(0);
  EXPECT_TRUE(b.coincide);
  const std::vector<Pose> poses = reference_poses(scene);
  const Pose first = poses[0] * b.from.placement, second = poses[1] * b.to.placement;
  EXPECT_LT((first.p - second.p).norm(), 1e-16);
  EXPECT_LT((first.R - second.R).norm(), 1e-15);
  std::string text = kBushing;
  text.replace(text.find("\"femur\" }"), 9, "\"femur\", origin = [0, 0, 5] }");
  EXPECT_FALSE(bushing_of(text).coincide);
  EXPECT_TRUE(bushing_of(text).to.placement.p.isApprox(Vec3(0, 0, 5e-3), 1e-15));
}

TEST(ReadBushings, AMatrixIsInNewtonsMetresAndRadians) {
  std::string text = kBushing.substr(0, kBushing.find("stiffness"));
  text +=
      "matrix = [[1000, 5, 0, 0, 0, 2], [5, 1000, 0, 0, 0, 0], [0, 0, 1000, 0, 0, 0], [0, 0, 0, 3, 0, 0],\n"
      "  [0, 0, 0, 0, 3, 0], [2, 0, 0, 0, 0, 3]]\n";
  const BushingDef b = bushing_of(text);
  ASSERT_TRUE(b.matrix.has_value());
  EXPECT_EQ((*b.matrix)(0, 5), 2);
  EXPECT_EQ((*b.matrix)(1, 0), 5);
  const auto refused = [&](const std::string& before, const std::string& after, const std::string& found,
                           const std::string& rule) {
    std::string other = text;
    other.replace(other.find(before), before.size(), after);
    expect_refused(kPlace, other.replace(other.find("= [["), 4, "= @[[") + kPlace, "bushing.pad.matrix", found, rule);
  };
  refused("[5, 1000", "[6, 1000", "[[1000, 5, 0, 0, 0, 2], [6, 1000, 0, 0, 0, 0], [0, 0, 1000, ...",
          "must be symmetric: row 2, column 1 is 6, row 1, column 2 is 5");
  refused("[0, 0, 0, 3, 0, 0]", "[0, 0, 0, -3, 0, 0]",
          "[[1000, 5, 0, 0, 0, 2], [5, 1000, 0, 0, 0, 0], [0, 0, 1000, ...", "must not be negative in any direction");
}

TEST(ReadBushings, Errors) {
  expect_bushing_refused("\"femur\"", "@\"fmur\"", ".to.body", "\"fmur\"", "did you mean \"femur\"?");
  expect_bushing_refused("[10, 20, 30]", "[10, @-20, 30]", ".stiffness[2]", "-20", ">= 0");
  expect_bushing_refused("stiffness = [10", "@stifness = [10", ".stifness", "[10, 20, 30]",
                         "did you mean \"stiffness\"?");
  expect_bushing_refused("rotation_stiffness = [1", "@damping = [1", ".damping", "[1, 2, 3]",
                         "only in a scene with [dynamics]");
}

TEST(ReadBushings, BodiesThatGiveItNothingToDo) {
  std::string text = kBushing;
  text.replace(text.find("[bushing.pad]"), 13, "[bushing.@pad]");
  const std::string femur = "{ body = \"femur\" }";
  std::string same = text;
  same.replace(same.find(femur), femur.size(), "{ body = \"tibia\" }");
  expect_refused(kPlace, same + kPlace, "bushing.pad", "", "both frames are on the same body");
  std::string soft = text.substr(0, text.find("stiffness"));
  expect_refused(kPlace, soft + kPlace, "bushing.pad.stiffness", "",
                 "a bushing needs stiffness, rotation_stiffness or matrix");
}

}  // namespace
}  // namespace genu::scene_test
