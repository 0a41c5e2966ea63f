// The elastic foundation as a way in: it balances from far and ends near the rigid pose.
#include "genu/equilibrium/stiffness_homotopy.h"

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

TEST(StiffnessHomotopy, BringsABallToItsFloor) {
  for (const double z : {12.0, 15.0, 19.0, 22.0, 35.0}) {
    const auto s =
        test::scene_model(test::held_ball(test::step("prescribe = { " + test::kNoTurn + " }\nload = { lift = 0 }"), z));
    ContactField field(s.model);
    State state = reference_state(s.model);
    const SeedReport report = stiffness_homotopy(s.model, field, test::target_of(s.scene), state);
    ASSERT_TRUE(report.balanced) << z;
    EXPECT_GT(report.iterations, 0);
    // Stiffened until little overlap is left, but some: it is what carries the ball.
    EXPECT_GT(report.deepest, 0) << z;
    EXPECT_LT(report.deepest, 2e-3 * s.model.scales.length) << z;
    EXPECT_NEAR(state.poses[1].p.z(), 0.02 - report.deepest, 3e-5) << z;
    EXPECT_TRUE(state.contacts.empty());
    EXPECT_EQ(state.multipliers.size(), 3u);
  }
}

TEST(StiffnessHomotopy, EndsNearTheRigidKnee) {
  const auto k = test::solved_knee(20);
  ContactField field(k.scene.model);
  State state = reference_state(k.scene.model);
  const SeedReport report = stiffness_homotopy(k.scene.model, field, k.target, state);
  ASSERT_TRUE(report.balanced);
  EXPECT_LT((state.poses[1].p - k.pose.state.poses[1].p).norm(), 5e-4);
  EXPECT_LT(log_rotation(state.poses[1].R * k.pose.state.poses[1].R.transpose()).norm(), 0.02);
  EXPECT_NEAR(state.coordinates[0][0], k.target.prescribed[0].value, 1e-4);
}

TEST(StiffnessHomotopy, SaysWhenNothingHolds) {
  const auto s =
      test::scene_model(test::bone_on_ground("{ z = 30 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                        test::surface("floor", "ground", "plane") + test::contact("c", "ball", "floor") +
                        test::load("w", "force = [0, 0, 50]"));
  ContactField field(s.model);
  State state = reference_state(s.model);
  EXPECT_FALSE(stiffness_homotopy(s.model, field, test::target_of(s.scene), state).balanced);
}

}  // namespace
}  // namespace genu
