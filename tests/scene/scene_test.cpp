#include "genu/scene/scene.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

using Comparison = RegionDef::Comparison;

TEST(Scene, RegionContainsItsEdgeOnlyWhereItSaysSo) {
  const auto region = [](Comparison c) { return RegionDef{"r", {{.axis = 1, .comparison = c, .value = 0.5}}}; };
  const Vec3 below(9, 0.4, -9), on(9, 0.5, -9), above(9, 0.6, -9);
  const auto inside = [&](Comparison c) {
    const RegionDef r = region(c);
    return std::array<bool, 3>{r.contains(below), r.contains(on), r.contains(above)};
  };
  EXPECT_EQ(inside(Comparison::less), (std::array<bool, 3>{true, false, false}));
  EXPECT_EQ(inside(Comparison::less_equal), (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(inside(Comparison::greater), (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(inside(Comparison::greater_equal), (std::array<bool, 3>{false, true, true}));
}

TEST(Scene, RegionIsTheIntersectionOfItsConditions) {
  const RegionDef r{"r",
                    {{.axis = 2, .comparison = Comparison::greater_equal, .value = 0},
                     {.axis = 0, .comparison = Comparison::less, .value = 5}}};
  EXPECT_TRUE(r.contains({4, 0, 0}));
  EXPECT_FALSE(r.contains({5, 0, 0}));
  EXPECT_FALSE(r.contains({4, 0, -1}));
}

TEST(Scene, CoordinateName) {
  Scene scene;
  JointDef joint;
  joint.name = "knee";
  for (std::size_t k = 0; k < 3; ++k) {
    joint.rotations[k].name = "r" + std::to_string(k);
    joint.translations[k] = "t" + std::to_string(k);
  }
  scene.joints = {JointDef{}, joint};
  EXPECT_EQ(coordinate_name(scene, {1, 0}), "knee.r0");
  EXPECT_EQ(coordinate_name(scene, {1, 2}), "knee.r2");
  EXPECT_EQ(coordinate_name(scene, {1, 3}), "knee.t0");
  EXPECT_EQ(coordinate_name(scene, {1, 5}), "knee.t2");
}

}  // namespace
}  // namespace genu
