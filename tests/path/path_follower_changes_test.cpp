// Changes of contacts are located without searching at every pose that is looked at.
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "genu/path/path_follower.h"
#include "support/solved.h"

namespace genu {
namespace {

constexpr std::int64_t kSearches = 9;  // both sides of a change, what settles beyond it, and the ends of the step

/// One step of a scene, and how many searches it took.
struct OneStep {
  test::Followed followed;
  std::int64_t searches = 0;  ///< besides one a substep

  explicit OneStep(const std::string& text) {
    auto scene = test::scene_model(text);
    scene.model.meter = std::make_shared<EffectMeter>();
    followed = test::follow(scene.model, plan_steps(scene.scene));
    searches = scene.model.meter->evaluations(Effect::contact_search) - followed.result.substeps;
    test::expect_judged_ok(scene, followed.points);
  }
};

TEST(PathFollowerChanges, AContactThatPullsAndAPlaceThatOverlaps) {
  for (const auto& [load, kind] :
       {std::pair{"[0, 100]", PathEvent::Kind::contact_lost}, {"[100, 0]", PathEvent::Kind::contact_gained}}) {
    const OneStep s(
        test::held_ball(test::step("prescribe = { " + test::kNoTurn + " }\nload = { lift = " + load + " }")));
    ASSERT_TRUE(s.followed.result.complete) << s.followed.story();
    const auto changes = s.followed.of(kind);
    ASSERT_EQ(changes.size(), 1u) << s.followed.story();
    EXPECT_NEAR(changes[0].target.load_factors[0], test::kLiftOff, 1e-6);
    EXPECT_LE(s.searches, kSearches) << load;
  }
}

TEST(PathFollowerChanges, AContactThatSplits) {
  // A ball of 10 mm in the trough z = (0.04 + 0.001 y) x^2 (mm): at the bottom the trough is as curved as the ball at
  // y = 10 mm. From there on the ball stands on both flanks.
  const OneStep s(test::bone_on_ground("{ z = 10, y = 2 }") + test::surface("ball", "bone", "sphere", "radius = 10") +
                  test::surface("trough", "ground", "polynomial", "terms = [[2, 0, 0.04], [2, 1, 0.001]]") +
                  test::contact("c", "ball", "trough") + test::load("w", "force = [0, 0, -10]") +
                  test::step("prescribe = { \"j.y\" = [2, 14], " + test::kNoTurn + " }\nincrements = 6"));
  ASSERT_TRUE(s.followed.result.complete) << s.followed.story();
  const auto gained = s.followed.of(PathEvent::Kind::contact_gained);
  ASSERT_EQ(gained.size(), 1u) << s.followed.story();
  EXPECT_NEAR(1e3 * s.followed.points.back().pose.state.poses[1].p.y(), 14, 1e-9);
  EXPECT_NEAR(2 + 12 * gained[0].t, 10, 0.05);  // seen when the places beside it are deeper than rounding
  EXPECT_GE(2 + 12 * gained[0].t, 10);
  EXPECT_EQ(s.followed.points.back().pose.state.contacts.size(), 2u);
  EXPECT_EQ(s.followed.of(PathEvent::Kind::contact_lost).size(), 0u) << s.followed.story();
  EXPECT_LE(s.searches, 2 * kSearches);
}

TEST(PathFollowerChanges, TwoContactsThatOpenInOneStep) {
  // Two balls under a bone that a load tips and another lifts: one foot after the other leaves the floor.
  const std::string feet = test::bone_on_ground("{ z = 20 }") +
                           test::surface("left", "bone", "sphere", "origin = [-30, 0, 0]\nradius = 20") +
                           test::surface("right", "bone", "sphere", "origin = [30, 0, 0]\nradius = 20") +
                           test::surface("floor", "ground", "plane") + test::contact("l", "left", "floor") +
                           test::contact("r", "right", "floor") +
                           test::spring("s", "[-20, 0, 0]", "[-20, 0, -20]", 2, 10) +
                           test::spring("t", "[20, 0, 0]", "[20, 0, -20]", 2, 10) +
                           test::load("lift", "force = [0, 0, 1]\npoint = [5, 0, 0]");
  const OneStep s(feet +
                  test::step("prescribe = { \"j.a\" = 0, \"j.c\" = 0, \"j.y\" = 0 }\nload = { lift = [0, 200] }"));
  ASSERT_TRUE(s.followed.result.complete) << s.followed.story();
  const auto lost = s.followed.of(PathEvent::Kind::contact_lost);
  ASSERT_EQ(lost.size(), 2u) << s.followed.story();
  EXPECT_EQ(lost[0].what, "r.1");
  EXPECT_EQ(lost[1].what, "l.1");
  EXPECT_LT(lost[0].t, lost[1].t);
  EXPECT_LE(s.searches, 4 * kSearches);
}

TEST(PathFollowerChanges, AContactBeforeALigamentInOneStep) {
  // A ball comes down to the floor while a linear rope is about to become taut: wherever that is, the contact is found
  // where it begins.
  const auto gained_at = [](double taut) {
    const OneStep s(
        test::bone_on_ground("{ z = 20.5 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
        test::surface("floor", "ground", "plane") + test::contact("foot", "ball", "floor") +
        test::ligament("rope", "[0, 0, -10]", "[0, 0, -10]",
                       "law = \"quadratic\"\nstiffness = 5000\nslack_length = 18") +
        test::ligament("side", "[0, 0, 0]", "[-50, 0, 20]",
                       "law = \"linear\"\nstiffness = 500\nslack_length = " + std::to_string(50 + 10 * taut)) +
        test::load("lift", "force = [0, 0, 1]") +
        test::step("prescribe = { " + test::kNoTurn + ", \"j.x\" = [0, 10] }\nload = { lift = [100, 0] }"));
    EXPECT_TRUE(s.followed.result.complete) << s.followed.story();
    const auto gained = s.followed.of(PathEvent::Kind::contact_gained);
    EXPECT_EQ(gained.size(), 1u) << s.followed.story();
    return gained.empty() ? 0 : gained[0].t;
  };
  const double where = gained_at(0.9);
  for (const double taut : {0.272, 0.275, 0.278, 0.281, 0.284, 0.287, 0.29, 0.293, 0.296, 0.299})
    EXPECT_NEAR(gained_at(taut), where, 2e-8) << taut;
}

}  // namespace
}  // namespace genu
