// Slides between rigid surfaces to poses of rest that closed forms give.
#include "genu/equilibrium/rigid_descent.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::kNoTurn;
using test::step;

/// A ball of 5 mm on z = 1e-4 x^4 - 0.02 x^2 + 0.02 x y (mm): two valleys at x = -10 and 10 mm where y = 0.
std::string two_valleys(const std::string& reference, const std::string& steps) {
  return test::bone_on_ground(reference) + test::surface("ball", "bone", "sphere", "radius = 5") +
         test::surface("valleys", "ground", "polynomial", "terms = [[4, 0, 1e-4], [2, 0, -0.02], [1, 1, 0.02]]") +
         test::contact("c", "ball", "valleys") + test::load("w", "force = [0, 0, -10]") + steps;
}

struct Slide {
  test::SceneModel scene;
  ContactField field;
  State state;
  RestReport report;

  explicit Slide(const std::string& text)
      : scene(test::scene_model(text)), field(scene.model), state(reference_state(scene.model)) {
    report = slide_to_rest(scene.model, field, test::target_of(scene.scene), state);
  }
  Vec3 place() const { return 1e3 * state.poses[1].p; }
};

TEST(RigidDescent, RestsInTheValleyDownhill) {
  for (const double x : {1.0, -1.0, 4.0, -12.0}) {
    const Slide slide(two_valleys("{ x = " + std::to_string(x) + ", z = 5.2 }",
                                  step("prescribe = { \"j.y\" = 0, " + kNoTurn + " }")));
    ASSERT_TRUE(slide.report.at_rest) << x;
    ASSERT_EQ(slide.report.pressing.size(), 1u) << x;
    // The slope along y is 0.02 x there: the prescribed y takes part of the contact force.
    EXPECT_GT(slide.place().x() * (x > 0 ? 1 : -1), 9) << x;
    EXPECT_NEAR(slide.report.forces[0], 10 * std::hypot(1, 0.02 * slide.place().x()), 0.05) << x;
  }
}

TEST(RigidDescent, SlidesOnWhereAFoldHasTakenItsValley) {
  // The valley at x < 0 ends at y = 7.7 mm. At y = 9 mm a ball left there slides to the other one.
  const Slide slide(two_valleys("{ x = 6, y = 9, z = 5.5 }", step("prescribe = { \"j.y\" = 9, " + kNoTurn + " }")));
  ASSERT_TRUE(slide.report.at_rest);
  EXPECT_LT(slide.place().x(), -10);
}

TEST(RigidDescent, NoRestWhereNothingStopsTheBody) {
  const Slide slide(test::bone_on_ground("{ z = 5 }") + test::surface("ball", "bone", "sphere", "radius = 5") +
                    test::surface("floor", "ground", "plane") + test::contact("c", "ball", "floor") +
                    test::load("w", "force = [1, 0, -10]") + step("prescribe = { \"j.y\" = 0, " + kNoTurn + " }"));
  EXPECT_FALSE(slide.report.at_rest);
}

}  // namespace
}  // namespace genu
