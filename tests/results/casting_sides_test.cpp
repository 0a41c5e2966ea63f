// Which surfaces of a scene cast, and what is found on them.
#include "genu/results/casting_sides.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/scene_model.h"

namespace genu {
namespace {

test::SceneModel pressed_ball(const std::string& more) {
  return test::scene_model(test::bone_on_ground("{ z = 19 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                           test::surface("floor", "ground", "plane") +
                           "[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"cartilage\"\nmodulus = 5\n"
                           "poisson = 0.4\nthickness = 4\n" +
                           more + test::step(""));
}

TEST(CastingSides, AreThoseOfTheLayer) {
  const test::SceneModel one = pressed_ball("quadrature = \"triangles\"\ncast_from = \"ball\"\n");
  const std::vector<CastingSide> sides = casting_sides(one.scene, one.model);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_EQ(one.scene.surfaces[at(sides[0].surface)].name, "ball");
  EXPECT_EQ(one.model.bodies[at(sides[0].body)].name, "bone");
  const test::SceneModel both = pressed_ball("quadrature = \"smooth\"\n");
  ASSERT_EQ(casting_sides(both.scene, both.model).size(), 2u);
  for (const CastingSide& side : casting_sides(both.scene, both.model))
    EXPECT_EQ(both.model.bodies[at(side.body)].name, side.surface == 0 ? "bone" : "ground");
}

TEST(CastingSides, AreVisitedWhereTheyCarryPressure) {
  const test::SceneModel ball = pressed_ball("quadrature = \"triangles\"\ncast_from = \"ball\"\n");
  State state = reference_state(ball.model);
  std::vector<ElasticLayer::Memory> memories;
  const CastingSide side = casting_sides(ball.scene, ball.model).at(0);
  ElasticLayer::Memory memory;
  const LayerTotals total = report_layer(ball.model, {}, state, 0, memory).total;
  double peak = 0;
  const auto note = [&](const LayerPoint& point) { peak = std::max(peak, point.pressure); };
  visit_side(ball.model, side, state.poses, memories, 0, note);
  EXPECT_EQ(memories.size(), 1u);
  EXPECT_GT(peak, 0);
  EXPECT_EQ(peak, total.max_pressure);
  state.poses[1].p.z() = 0.03;  // off the floor
  peak = 0;
  visit_side(ball.model, side, state.poses, memories, 0, note);
  EXPECT_EQ(peak, 0);
}

}  // namespace
}  // namespace genu
