// Derivatives of poses with a closed form; those without one are held to re-solves in tests/validation.
#include "genu/equilibrium/sensitivity.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::follow;

struct Differentiated {
  test::SceneModel scene;
  PosePoint point;
  std::vector<Parameter> parameters;

  explicit Differentiated(const std::string& text) : scene(test::scene_model(text)) {
    const test::Followed w = follow(scene);
    EXPECT_TRUE(w.result.complete) << w.story();
    point = w.points.back();
    parameters = parameters_of(scene.scene);
  }
  Sensitivity to(const std::string& name) const {
    Sensitivity s(scene.scene, scene.model);
    EXPECT_TRUE(s.factor(point));
    const auto it =
        std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
    EXPECT_NE(it, parameters.end()) << name;
    s.differentiate(*it);
    return s;
  }
};

const std::string kHeldStill =
    test::step("prescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0, \"j.x\" = 0, \"j.y\" = 0 }");

TEST(Sensitivity, OfAMassOnASpring) {
  // k (L - L0) = F: dL/dk = -F / k^2, dL/dL0 = 1, dL/dF = -1 / k along -z; the hanger's end moves the mass with it.
  const double k = 2000, force = 30;
  const Differentiated d(test::bone_on_ground("{ z = -60 }") + test::spring("s", "[0, 0, 0]", "[0, 0, 0]", 2, 50) +
                         test::load("pull", "force = [0, 0, -30]") + kHeldStill);
  EXPECT_NEAR(d.to("s.stiffness").ligament(0).length, -force / (k * k), 1e-15);
  EXPECT_NEAR(d.to("s.stiffness").ligament(0).force, 0, 1e-12);
  EXPECT_NEAR(d.to("s.slack_length").ligament(0).length, 1, 1e-12);
  EXPECT_NEAR(d.to("s.slack_length").coordinate({0, 5}), -1, 1e-12);
  EXPECT_NEAR(d.to("pull.force.z").coordinate({0, 5}), 1 / k, 1e-15);
  EXPECT_NEAR(d.to("pull.force.z").ligament(0).force, -1, 1e-12);
  EXPECT_NEAR(d.to("pull.factor").ligament(0).force, force, 1e-10);
  EXPECT_NEAR(d.to("s.to.z").coordinate({0, 5}), 1, 1e-12);
  EXPECT_NEAR(d.to("s.to.z").ligament(0).length, 0, 1e-12);
  // A quarter turn of the line of action costs a side force: F / L of it per unit of offset.
  EXPECT_NEAR(d.to("s.to.x").reaction({0, 3}), -force / 65e-3, 1e-9);
  EXPECT_TRUE(std::isnan(d.to("s.to.x").reaction({0, 5})));
}

TEST(Sensitivity, OfABallOnAFloor) {
  // A rope pulls the ball down: its radius and the floor's height lift it and stretch the rope; K e^2 at 2 mm of 18.
  const Differentiated d(test::held_ball(test::step("prescribe = { " + test::kNoTurn + " }\nload = { lift = 0 }")));
  const double stiffness = 2 * 5000 * (2.0 / 18) / 18e-3;  // N/m
  for (const char* name : {"ball.radius", "ball.offset", "floor.offset", "floor.origin.z"}) {
    const Sensitivity s = d.to(name);
    EXPECT_NEAR(s.coordinate({0, 5}), 1, 1e-9) << name;
    EXPECT_NEAR(s.ligament(0).length, 1, 1e-9) << name;
    EXPECT_NEAR(s.closed(0).force / stiffness, 1, 1e-9) << name;
    EXPECT_EQ(s.closed(0).gap, 0);
  }
  EXPECT_NEAR(d.to("ball.radius").closed(0).a.z(), -1, 1e-9);    // in the ball, below its centre
  EXPECT_NEAR(d.to("floor.origin.z").closed(0).a.z(), 0, 1e-9);  // the ball moves with the floor
  EXPECT_NEAR(d.to("floor.origin.z").closed(0).b.z(), 1, 1e-9);
  EXPECT_NEAR(d.to("lift.factor").closed(0).force, -1, 1e-9);  // 1 N less on the floor
  EXPECT_NEAR(d.to("rope.stiffness").closed(0).force, std::pow(2.0 / 18, 2), 1e-12);
}

TEST(Sensitivity, IsRefusedWhereThePoseIsNotDetermined) {
  // Without prescribed turns the ball's spin about the rope costs nothing.
  const auto scene = test::scene_model(test::held_ball("[[step]]\nload = { lift = 0 }\n"));
  const test::Followed w = follow(scene);
  ASSERT_FALSE(w.points.empty());
  Sensitivity s(scene.scene, scene.model);
  EXPECT_FALSE(s.factor(w.points.back()));
}

}  // namespace
}  // namespace genu
