// Surveys over all pairs, and the elastic foundation against closed forms and finite differences.
#include "genu/model/contact_field.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "genu/surface/facet_surface.h"
#include "support/scene_model.h"
#include "support/wrench_difference.h"

namespace genu {
namespace {

/// Two balls of 20 mm, 60 mm apart, fixed in bone over a floor; springs give the scene its size.
test::SceneModel two_balls() {
  return test::scene_model(test::bone_on_ground("{ z = 20 }") +
                           test::surface("left", "bone", "sphere", "origin = [-30, 0, 0]\nradius = 20") +
                           test::surface("right", "bone", "sphere", "origin = [30, 0, 0]\nradius = 20") +
                           test::surface("floor", "ground", "plane") + test::contact("l", "left", "floor") +
                           test::contact("r", "right", "floor") +
                           test::spring("s", "[-20, 0, 0]", "[-20, 0, 20]", 1, 20) +
                           test::spring("t", "[20, 0, 0]", "[20, 0, 20]", 1, 20));
}

State placed(const JointModel& model, double z, double tilt = 0) {
  State state = reference_state(model);
  state.poses[1] = {exp_rotation({0, tilt, 0}), {0, 0, z}};
  update_coordinates(model, state);
  return state;
}

TEST(ContactField, SurveysEveryPair) {
  const auto s = two_balls();
  ContactField field(s.model);
  Survey survey;
  // Tilted by 1 mrad the left ball is 30 micrometres up and the right one as much down.
  field.survey(placed(s.model, 0.02, 1e-3), survey);
  ASSERT_EQ(survey.minima.size(), 2u);
  EXPECT_EQ(survey.minima[0].pair, 0);
  EXPECT_EQ(survey.minima[1].pair, 1);
  const double lift = 0.03 * std::sin(1e-3);
  EXPECT_NEAR(survey.minima[0].minimum.gap, lift, 1e-15);
  EXPECT_NEAR(survey.minima[1].minimum.gap, -lift, 1e-15);
  EXPECT_NEAR(survey.smallest_gap[1], -lift, 1e-15);
  field.survey(placed(s.model, 0.05), survey);
  EXPECT_TRUE(survey.minima.empty());
  EXPECT_EQ(survey.smallest_gap[0], std::numeric_limits<double>::infinity());
}

TEST(ContactField, SmallestGapIsFoundAtAnyDistance) {
  const auto s = two_balls();
  ContactField field(s.model);
  for (const double z : {0.0199, 0.0201, 0.022, 0.05, 0.2})
    EXPECT_NEAR(field.smallest_gap(placed(s.model, z), 0), z - 0.02, 1e-13) << z;
}

TEST(ContactField, IsClearUpToItsGap) {
  const auto s = two_balls();
  ContactField field(s.model);
  for (const double gap : {1e-4, 3e-3, 0.1}) {
    EXPECT_TRUE(field.is_clear(placed(s.model, 0.02 + gap), 0, 0.99 * gap)) << gap;
    EXPECT_FALSE(field.is_clear(placed(s.model, 0.02 + gap), 0, 1.01 * gap + 5e-5)) << "but for what samples miss";
  }
  EXPECT_FALSE(field.is_clear(placed(s.model, 0.01), 0, 0));
}

TEST(ContactField, FollowsAContactOverItsSurface) {
  const auto s = two_balls();
  ContactField field(s.model);
  Survey survey;
  field.survey(placed(s.model, 0.02), survey);
  ASSERT_EQ(survey.minima.size(), 2u);
  const auto followed = field.follow(placed(s.model, 0.021, 0.05), 0, survey.minima[0].minimum.contact);
  ASSERT_TRUE(followed && followed->settled);
  EXPECT_NEAR(followed->minimum.gap, 0.021 + 0.03 * std::sin(0.05) - 0.02, 1e-15);
}

TEST(ContactField, FoundationCarriesAPressedBall) {
  // Depth d of a ball: volume of the cap pi R d^2 (1 - d / 3R) to first order in the samples; force modulus * volume.
  const auto s = two_balls();
  ContactField field(s.model);
  const double depth = 1e-3, modulus = 1e10;
  Linearization out;
  out.wrench.setZero(6);
  out.stiffness.setZero(6, 6);
  EXPECT_NEAR(field.add_foundation(placed(s.model, 0.02 - depth), modulus, out), depth, 3e-5);
  const double force = 2 * modulus * M_PI * 0.02 * depth * depth;
  EXPECT_NEAR(out.wrench[2], force, 0.05 * force);
  EXPECT_LT(out.wrench.head<2>().norm(), 1e-3 * force);
  EXPECT_NEAR(out.stiffness(2, 2), -2 * force / depth, 0.1 * force / depth);
}

TEST(ContactField, FoundationsStiffnessDescribesItsForce) {
  // Gauss-Newton: exact for the translation along the floor's normal, where no direction changes.
  const auto s = two_balls();
  ContactField field(s.model);
  const auto wrench = [&](double z) {
    Linearization out;
    out.wrench.setZero(6);
    out.stiffness.setZero(6, 6);
    field.add_foundation(placed(s.model, z, 0.01), 1e10, out);
    return out;
  };
  const double z = 0.019, h = 1e-7;
  const VecX difference = (wrench(z + h).wrench - wrench(z - h).wrench) / (2 * h);
  EXPECT_LT((wrench(z).stiffness.col(2) - difference).norm(), 1e-4 * difference.norm());
}

/// A surface of triangles with a place that is not to be trusted.
std::shared_ptr<const Surface> flawed(Mesh mesh, const Vec3& place) {
  auto surface = std::make_shared<FacetSurface>(std::move(mesh));
  surface->set_doubtful({{"a fold", {place}, 1e-3, false}});
  return surface;
}

TEST(ContactField, ALayerLeansOnAFlawWhereItPressesAndNowhereElse) {
  // 0.1 mm deep two balls press a circle of 1.4 mm.
  const std::string text =
      test::bone_on_ground("{ z = 39.9 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
      test::surface("knob", "ground", "sphere", "radius = 20") + test::spring("s", "[0, 0, 0]", "[0, 0, -30]", 1, 20);
  for (const std::string quadrature :
       {"smooth\"", "triangles\"\ncast_from = \"ball\"", "triangles\"\ncast_from = \"knob\""}) {
    test::SceneModel s = test::scene_model(text + test::layer("soft", "ball", "knob", "quadrature = \"" + quadrature));
    const std::shared_ptr<const Surface> ball = s.model.layers[0].a, knob = s.model.layers[0].b;
    State touching = reference_state(s.model), apart = touching;
    apart.poses[1].p.z() = 0.0401;
    for (const double x : {0.0, 1e-3, 4e-3})
      for (const bool on_ball : {true, false}) {
        const Vec3 place(x, 0, (on_ball ? -1 : 1) * std::sqrt(0.02 * 0.02 - x * x));
        s.model.layers[0].a = on_ball ? flawed(ball->triangles(5e-3, Vec3::Zero(), 0.1), place) : ball;
        s.model.layers[0].b = on_ball ? knob : flawed(knob->triangles(5e-3, Vec3::Zero(), 0.1), place);
        ContactField field(s.model);
        ASSERT_TRUE(field.any_doubtful());
        const DoubtfulPlace* found = field.doubtful(touching);
        EXPECT_EQ(found != nullptr, x < 3e-3) << quadrature << " " << on_ball << " " << x;
        if (found != nullptr) {
          EXPECT_EQ(found->what, "a fold");
        }
        EXPECT_EQ(field.doubtful(apart), nullptr) << quadrature << " " << on_ball << " " << x;
      }
  }
}

TEST(ContactField, ALayerThatLiesDeeperThanItsRaysLookIsSeen) {
  const std::string text = test::bone_on_ground("{ z = 20 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                           test::surface("floor", "ground", "plane") +
                           test::spring("s", "[0, 0, 0]", "[0, 0, -30]", 1, 20);
  for (const std::string quadrature :
       {"smooth\"", "triangles\"\ncast_from = \"ball\"", "triangles\"\ncast_from = \"floor\""})
    for (const bool swapped : {false, true}) {
      const test::SceneModel s =
          test::scene_model(text + test::layer("soft", swapped ? "floor" : "ball", swapped ? "ball" : "floor",
                                               "quadrature = \"" + quadrature));
      ContactField field(s.model);
      for (const double deep : {-5e-3, 0.0, 1e-3, 3e-3}) {  // the layer is 4 mm thick, and its rays look as deep
        EXPECT_FALSE(field.buried(placed(s.model, 20e-3 - deep))) << quadrature << swapped << " " << deep;
      }
      for (const double deep : {8e-3, 20e-3, 45e-3, 120e-3}) {
        const auto found = field.buried(placed(s.model, 20e-3 - deep));
        ASSERT_TRUE(found) << quadrature << swapped << " " << deep;
        EXPECT_NEAR(found->depth, deep, 1e-3) << quadrature << swapped;
      }
    }
}

}  // namespace
}  // namespace genu
