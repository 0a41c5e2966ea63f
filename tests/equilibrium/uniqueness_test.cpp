// Poses and forces that are one of many are called so, and only those.
#include "genu/equilibrium/uniqueness.h"

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::contact;
using test::load;
using test::spring;
using test::step;
using test::surface;

/// A ball of 6 mm on a plate, another plate `above` its centre (mm), and `weight` (N) on it.
std::string between_plates(double above, const std::string& weight) {
  return bone_on_ground() + surface("ball", "bone", "sphere", "radius = 6") +
         surface("below", "ground", "plane", "origin = [0, 0, -6]") +
         surface("above", "ground", "plane", "origin = [0, 0, " + std::to_string(above) + "]\nz_axis = [0, 0, -1]") +
         contact("b", "ball", "below") + contact("a", "ball", "above") +
         spring("hold", "[0, 0, 0]", "[0, 0, 0]", 1, 0) + load("w", "force = [0, 0, -" + weight + "]") +
         step("prescribe = { " + test::kNoTurn + " }\nload = { w = 1 }");
}

TEST(Uniqueness, PlatesThatABallFitsBetweenShareItsWeightInAnyWay) {
  for (const char* weight : {"7", "0.001", "1000"}) {
    const auto w = test::follow(between_plates(6, weight));
    ASSERT_FALSE(w.points.empty());
    EXPECT_EQ(w.points[0].report.status, PoseStatus::undetermined) << weight << w.story();
    EXPECT_EQ(w.points[0].undetermined.shared_contacts.size(), 2u) << weight;
    EXPECT_FALSE(w.points[0].report.why.empty());
    EXPECT_FALSE(w.result.complete);
  }
}

TEST(Uniqueness, WithAMicrometreToSpareOneOfThemCarriesIt) {
  const auto w = test::follow(between_plates(6.001, "7"));
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.points[0].pose.state.contacts.size(), 1u);
  EXPECT_NEAR(w.points[0].pose.state.contacts[0].force, 7, 1e-9);
}

}  // namespace
}  // namespace genu
