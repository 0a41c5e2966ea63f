// Forces to begin with are those that balance, where such are there.
#include "genu/equilibrium/force_guess.h"

#include <gtest/gtest.h>

#include "genu/equilibrium/active_set.h"
#include "support/solved.h"

namespace genu {
namespace {

/// The held ball of solved.h as solved, its forces forgotten.
TEST(ForceGuess, IsTheBalanceWhereTheJointBalances) {
  const test::SceneModel built =
      test::scene_model(test::held_ball(test::step("prescribe = { " + test::kNoTurn + " }\nload = { lift = 0 }")));
  ContactField field(built.model);
  ActiveSetSolver solver(built.model, field, {});
  Balanced pose;
  pose.state = start_state(built.model);
  const Target target = plan_steps(built.scene).front().target(0);
  ASSERT_EQ(solver.settle_cold(pose, target).status, PoseStatus::ok);
  ASSERT_EQ(pose.state.contacts.size(), 1u);
  const double force = pose.state.contacts[0].force;
  pose.state.contacts[0].force = 0;
  ASSERT_TRUE(guess_forces(built.model, target, pose.state));
  EXPECT_NEAR(pose.state.contacts[0].force, force, 1e-9 * force);
}

}  // namespace
}  // namespace genu
