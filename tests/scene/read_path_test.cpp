#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kEnd = "to = { body = \"tibia\", point = [-6.04, 4.0, -3.0] }\n";

LigamentDef with_path(const std::string& more) { return good(edited(kEnd, kEnd + more)).ligaments.at(0); }

void expect_path_refused(const std::string& more, const std::string& key, const std::string& found,
                         const std::string& rule) {
  expect_refused(kEnd, kEnd + more, "ligament.AAC." + key, found, rule);
}

TEST(ReadPath, SurfacesByNameOrWithASide) {
  const LigamentDef l = with_path("wrap = [\"ball\", { surface = \"ball\", side = [0, 0, 2], inside = \"ignore\" }]\n");
  ASSERT_EQ(l.wraps.size(), 2u);
  EXPECT_EQ(l.wraps[0].surface, 0);
  EXPECT_FALSE(l.wraps[0].side);
  EXPECT_FALSE(l.wraps[0].ignore_inside);
  EXPECT_EQ(*l.wraps[1].side, Vec3(0, 0, 1));
  EXPECT_TRUE(l.wraps[1].ignore_inside);
  EXPECT_EQ(l.wraps[1].after, 0);
  EXPECT_FALSE(with_path("wrap = [{ surface = \"ball\", side = \"shortest\" }]\n").wraps.at(0).side);
}

TEST(ReadPath, PointsAndSurfacesInOneOrder) {
  const LigamentDef l = with_path(
      "path = [\"ball\", { body = \"femur\", point = [1, 2, 3] }, { surface = \"ball\" }, { body = \"tibia\", point = "
      "[4, 5, 6] }]\n");
  ASSERT_EQ(l.via.size(), 2u);
  EXPECT_EQ(l.via[1].body, 0);
  ASSERT_EQ(l.wraps.size(), 2u);
  EXPECT_EQ(l.wraps[0].after, 0);
  EXPECT_EQ(l.wraps[1].after, 1);
}

TEST(ReadPath, RefusesWhatHasNoWay) {
  expect_path_refused("wrap = @50\n", "wrap", "50", "surfaces");
  expect_path_refused("wrap = [@\"bal\"]\n", "wrap[1]", "\"bal\"", "ball");
  expect_path_refused("wrap = [@\"floor\"]\n", "wrap[1]", "\"floor\"", "plane");
  expect_path_refused("wrap = [{ surface = \"ball\", side = @[0, 0, 0] }]\n", "wrap[1].side", "[0, 0, 0]", "direction");
  expect_path_refused("wrap = [{ surface = \"ball\", side = @\"left\" }]\n", "wrap[1].side", "\"left\"", "shortest");
  expect_path_refused("wrap = [{ surface = \"ball\", @sides = 1 }]\n", "wrap[1].sides", "1", "side");
  expect_path_refused("wrap = [\"ball\"]\npath = @[\"ball\"]\n", "path", "[\"ball\"]", "leave out via and wrap");
  expect_path_refused("via = [{ body = \"femur\", point = [1, 2, 3] }]\nwrap = @[\"ball\"]\n", "wrap", "[\"ball\"]",
                      "path = [...]");
}

TEST(ReadPath, ACableIsALoad) {
  const std::string cable =
      "[load.pull]\nfrom = { body = \"femur\", point = [1, 2, 3] }\nto = { body = \"tibia\", point = [4, 5, 6] }\n"
      "wrap = [\"ball\"]\nmagnitude = 30\n\n";
  const LoadDef load = good(edited("[[step]]", cable + "[[step]]")).loads.at(1);
  EXPECT_EQ(load.kind, LoadDef::Kind::cable);
  ASSERT_EQ(load.points.size(), 2u);
  EXPECT_EQ(load.points[1].body, 0);
  EXPECT_EQ(load.wraps.size(), 1u);
  EXPECT_EQ(load.value, 30);
}

}  // namespace
}  // namespace genu::scene_test
