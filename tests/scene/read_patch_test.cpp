#include "scene/scene_text.h"

#include <numbers>

namespace genu::scene_test {
namespace {

const std::string kTube = "shape = \"polynomial\"\nchart = \"cylindrical\"\nterms = [[0, 0, 20], [1, 0, 1]]\n";

void expect_patch_refused(const std::string& shape, const std::string& patch, const std::string& key,
                          const std::string& found, const std::string& rule) {
  expect_refused(kBall, shape + patch + "\n", "surface.ball.patch" + key, found, rule);
}

TEST(ReadPatch, RangesInTheFilesUnits) {
  const auto surface = good(edited(kBall, kBall + "patch = { x = [-20, 10.5], z = [-5, 0], theta = [-90, 180] }\n"));
  const auto& patch = surface.surfaces.at(0).patch;
  ASSERT_TRUE(patch);
  EXPECT_DOUBLE_EQ(patch->box[0]->first, -0.02);
  EXPECT_DOUBLE_EQ(patch->box[0]->second, 0.0105);
  EXPECT_FALSE(patch->box[1]);
  EXPECT_DOUBLE_EQ(patch->box[2]->first, -0.005);
  EXPECT_DOUBLE_EQ(patch->theta->first, -std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(patch->theta->second, std::numbers::pi);
  EXPECT_FALSE(good(kGoodScene).surfaces.at(0).patch);
  EXPECT_TRUE(good(edited(kBall, kTube + "patch = { theta = [-180, 90] }\n")).surfaces.at(0).patch);
}

TEST(ReadPatch, Errors) {
  expect_patch_refused(kBall, "patch = @1", "", "1", "must be a table");
  expect_patch_refused(kBall, "patch = @{}", "", "a table", "needs at least one of x, y, z, theta");
  expect_patch_refused(kBall, "patch = { x = @3 }", ".x", "3", "a range [from, to]");
  expect_patch_refused(kBall, "patch = { y = @[3, 3] }", ".y", "[3, 3]", "from < to");
  expect_patch_refused(kBall, "patch = { z = [@\"a\", 3] }", ".z[1]", "\"a\"", "must be a number, in mm");
  expect_patch_refused(kBall, "patch = { x = [-1, 1], @w = [1, 2] }", ".w", "[1, 2]", "is no key of a patch");
  expect_patch_refused(kBall, "patch = { theta = @[0, 360] }", ".theta", "[0, 360]", "less than a full turn");
  expect_patch_refused(kTube, "patch = { theta = @[90, 200] }", ".theta", "[90, 200]", "within half a turn");
}

}  // namespace
}  // namespace genu::scene_test
