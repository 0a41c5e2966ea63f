// What is said of loads that pull a joint apart, and of those that do not.
#include "genu/equilibrium/adrift.h"

#include <string>

#include <gtest/gtest.h>

#include "genu/equilibrium/active_set.h"
#include "support/solved.h"

namespace genu {
namespace {

/// A ball of 20 mm over a floor, which a load of `force` (N) along z pulls; with more in the scene.
test::SceneModel ball(double force, const std::string& more = "") {
  return test::scene_model(test::bone_on_ground("{ z = 30 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                           test::surface("floor", "ground", "plane") + test::contact("c", "ball", "floor") +
                           test::load("w", "force = [0, 0, " + std::to_string(force) + "]") + more +
                           test::step("prescribe = { " + test::kNoTurn + " }"));
}

PoseReport settled(const test::SceneModel& s) {
  ContactField field(s.model);
  ActiveSetSolver solver(s.model, field, {});
  Balanced pose;
  pose.state = reference_state(s.model);
  pose.last_number.assign(s.model.pairs.size(), 0);
  return solver.settle_cold(pose, test::target_of(s.scene));
}

TEST(Adrift, ALoadThatLiftsTheBallIsNamedAsTheCause) {
  const PoseReport report = settled(ball(50));
  EXPECT_EQ(report.status, PoseStatus::no_equilibrium);
  EXPECT_TRUE(report.adrift);
  EXPECT_NE(report.why.find("the loads drive bone away"), std::string::npos) << report.why;
}

TEST(Adrift, ALoadThatPressesItIsNot) {
  const PoseReport report = settled(ball(-50));
  EXPECT_EQ(report.status, PoseStatus::ok) << report.why;
  EXPECT_FALSE(report.adrift);
}

TEST(Adrift, ATautLigamentHoldsIt) {
  const PoseReport report = settled(ball(50, test::spring("s", "[0, 0, 0]", "[0, 0, 0]", 2, 0)));
  EXPECT_EQ(report.status, PoseStatus::ok) << report.why;
  EXPECT_FALSE(report.adrift);
}

TEST(Adrift, OnlyFarAwayWithNothingTouchingOrTaut) {
  const auto s = ball(50), held = ball(50, test::spring("s", "[0, 0, 0]", "[0, 0, 0]", 2, 0));
  ContactField field(s.model), field_of_held(held.model);
  const State start = reference_state(s.model);
  State ended = start;
  EXPECT_EQ(adrift(s.model, field, start, ended), "");
  ended.poses[1].p.z() += 10 * s.model.scales.size;
  EXPECT_NE(adrift(s.model, field, start, ended), "");
  EXPECT_EQ(adrift(held.model, field_of_held, reference_state(held.model), ended), "");
  ended.poses[1].p += Vec3(10 * s.model.scales.size, 0, 0.019 - ended.poses[1].p.z());  // far, in the floor
  EXPECT_EQ(adrift(s.model, field, start, ended), "");
  EXPECT_EQ(adrift(s.model, field, start, State()), "");  // of a search that did not begin
}

}  // namespace
}  // namespace genu
