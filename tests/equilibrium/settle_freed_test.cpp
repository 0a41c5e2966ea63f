// What a step frees comes to rest through no body, and where nothing is in its way.
#include "genu/equilibrium/settle_freed.h"

#include <string>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

/// A ball of 4 mm held above a disc of radii 25, 25, `half` mm, then let go: a spring without length pulls it 12 mm
/// below the disc's middle.
test::Followed let_go(double half, bool with_disc = true) {
  const std::string disc =
      test::surface("ball", "bone", "sphere", "radius = 4") +
      test::surface("disc", "ground", "ellipsoid", "radii = [25, 25, " + std::to_string(half) + "]") +
      test::contact("c", "ball", "disc");
  const std::string held = "prescribe = { " + test::kNoTurn + ", \"j.z\" = 20 }",
                    free = "prescribe = { " + test::kNoTurn + " }";
  return test::follow(test::bone_on_ground("{ z = 20 }") + (with_disc ? disc : "") +
                      test::spring("s", "[0, 0, 0]", "[0, 0, -12]", 2, 0) + test::step(held) + test::step(free));
}

TEST(SettleFreed, TheBallComesToRestOnTheDisc) {
  for (const double half : {1.0, 4.0, 6.0}) {
    const auto w = let_go(half);
    ASSERT_TRUE(w.result.complete) << w.story();
    const PosePoint& last = w.points.back();
    EXPECT_NEAR(last.pose.state.poses[1].p.z(), 1e-3 * (half + 4), 1e-12) << half;
    ASSERT_EQ(last.pose.state.contacts.size(), 1U);
    EXPECT_NEAR(last.pose.state.contacts[0].force, 2 * (half + 4 + 12), 1e-8);
    EXPECT_EQ(last.stability.verdict, Stability::Verdict::stable);
  }
}

TEST(SettleFreed, WithNothingInItsWayItGoesWhereItIsPulled) {
  const auto w = let_go(1, false);
  ASSERT_TRUE(w.result.complete) << w.story();
  EXPECT_NEAR(w.points.back().pose.state.poses[1].p.z(), -0.012, 1e-12);
}

}  // namespace
}  // namespace genu
