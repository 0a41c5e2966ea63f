// A first pose under loads that are too large for it to be found at once, or for the layers.
#include "genu/path/raised_loads.h"

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

/// A ball of 20 mm on 4 mm of 5 MPa, 0.5 mm deep at its start, under a load (N).
std::string pressed_ball(const std::string& force) {
  return test::bone_on_ground("{ z = 19.5 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
         test::surface("floor", "ground", "plane") + test::layer("foot", "ball", "floor") +
         test::load("press", "force = [0, 0, -" + force + "]") +
         test::step(
             "prescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0, \"j.x\" = [1, 2], \"j.y\" = 0 }\n"
             "increments = 1");
}

RaisedLoads raised(const test::SceneModel& s) {
  ContactField field(s.model);
  ActiveSetSolver solver(s.model, field, {});
  Balanced start;
  start.state = start_state(s.model);
  start.last_number.assign(s.model.pairs.size(), 0);
  const StepPlan step = plan_steps(s.scene)[0];
  return raise_loads(solver, {}, approach_to(step, s.model, start.state, step.target(0).load_factors), step, start);
}

TEST(RaisedLoads, EndAtTheFirstValuesOfTheStepUnderAllOfThem) {
  const auto s = test::scene_model(pressed_ball("1000"));
  const RaisedLoads found = raised(s);
  EXPECT_TRUE(found.all);
  EXPECT_EQ(found.report.status, PoseStatus::ok);
  const test::Followed w = test::follow(s);
  ASSERT_TRUE(w.result.complete) << w.story();
  EXPECT_EQ(w.result.borne_loads, 0);
  EXPECT_NEAR(found.pose.state.coordinates[0][3], 1e-3, 1e-12);
  constexpr double kQuadrature = 1e-7;  // m: forces are integrated to 1e-4
  EXPECT_NEAR(found.pose.state.coordinates[0][5], w.points[0].pose.state.coordinates[0][5], kQuadrature);
}

TEST(RaisedLoads, EndWhereTheLayerCarriesNoMore) {
  // From pi K d^2 (R - d / 6), d = 4 mm: 2.6 kN.
  const test::Followed w = test::follow(pressed_ball("10000"));
  ASSERT_FALSE(w.points.empty());
  EXPECT_FALSE(w.points[0].solved()) << w.story();
  EXPECT_GT(w.result.borne_loads, 0.2);
  EXPECT_LT(w.result.borne_loads, 0.263);
}

TEST(RaisedLoads, AreNotLookedForWithoutLayers) {
  const auto s = test::scene_model(test::knee("[[step]]\nprescribe = { \"knee.flexion\" = [0, 60] }\n"));
  EXPECT_EQ(raised(s).borne, 0);
}

}  // namespace
}  // namespace genu
