// Accelerations and impacts of bodies that touch, against momentum, levers and difference quotients.
#include "genu/motion/equations_of_motion.h"
#include "genu/model/build_model.h"

#include "support/finite_difference.h"
#include "support/scene_model.h"

namespace genu {
namespace {

/// Two balls of 2 and 3 kg, radii 20 and 30 mm, that touch along x, in the order they are in.
const std::string kBalls = R"(format = 1
units = { length = "mm", angle = "rad" }
[body.ground]
fixed = true
[body.one]
mass = 2
inertia = [3e-4, 3e-4, 3e-4]
[body.two]
mass = 3
inertia = [1e-3, 1e-3, 1e-3]
[joint.j]
type = "free"
parent = "ground"
child = "one"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
[joint.k]
type = "free"
parent = "ground"
child = "two"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { x = 50 }
[surface.A]
body = "one"
shape = "sphere"
radius = 20
[surface.B]
body = "two"
shape = "sphere"
radius = 30
[contact.c]
surfaces = ["A", "B"]
model = "rigid"
[dynamics]
duration = 1
output_interval = 1
)";

struct Balls {
  Balls() {
    Diagnostics out;
    scene = parse_scene(kBalls, "s", out);
    for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
    std::vector<std::shared_ptr<const Surface>> surfaces;
    for (const SurfaceDef& s : scene->surfaces) surfaces.push_back(test::formula_surface(s));
    model = *build_model(place(*scene), surfaces, out);
    point.state = start_state(model);
    ActiveContact contact;
    contact.number = 1;
    EXPECT_TRUE(model.pairs[0].a->project({0.02, 0, 0}, contact.geometry.a));
    EXPECT_TRUE(model.pairs[0].b->project({-0.03, 0, 0}, contact.geometry.b));
    point.state.contacts = {contact};
    point.twist = VecX::Zero(12);
  }
  std::optional<Scene> scene;
  JointModel model;
  MotionPoint point;
};

TEST(EquationsOfMotion, AnInelasticImpactKeepsMomentum) {
  Balls balls;
  EquationsOfMotion equations(balls.model, 1e-12);
  balls.point.twist << 0.5, 0.1, 0, 1, 2, 3, -0.4, 0, 0.2, 0, 0, 1;
  const VecX before = balls.point.twist;
  VecX impulses;
  ASSERT_TRUE(equations.strike(balls.point, impulses));
  const VecX& after = balls.point.twist;
  const double common = (2 * 0.5 - 3 * 0.4) / 5;
  EXPECT_NEAR(after[0], common, 1e-14);
  EXPECT_NEAR(after[6], common, 1e-14);
  ASSERT_EQ(impulses.size(), 1);
  EXPECT_NEAR(impulses[0], 2 * (0.5 - common), 1e-14) << "N s, positive where it pushes apart";
  for (const int i : {1, 2, 3, 4, 5, 7, 8, 9, 10, 11}) EXPECT_NEAR(after[i], before[i], 1e-14) << "no friction " << i;
  EXPECT_NEAR(balls.point.dissipated, 0.5 * 2 * 3 / 5.0 * 0.9 * 0.9, 1e-14) << "of the reduced mass";
  EXPECT_EQ(balls.point.load_work, 0);
}

/// While they stay together each turns about the other: what that takes is the force between them.
TEST(EquationsOfMotion, AClosedContactKeepsItsGapToSecondOrder) {
  Balls balls;
  EquationsOfMotion equations(balls.model, 1e-12);
  balls.point.twist << 0, 0.3, 0.1, 0, 0, 5, 0, -0.2, 0, 1, 0, 0;
  ASSERT_TRUE(equations.complete(balls.point));
  const double apart = 0.05, across = 0.25 + 0.01;  // square of the relative speed across
  EXPECT_NEAR(balls.point.acceleration[6] - balls.point.acceleration[0], -across / apart, 1e-12);
  EXPECT_NEAR(balls.point.state.contacts[0].force, -2 * 3 / 5.0 * across / apart, 1e-12)
      << "it would have to pull: such a contact opens";
}

TEST(EquationsOfMotion, RateAndAccelerationOfAGap) {
  Balls balls;
  EquationsOfMotion equations(balls.model, 1e-12);
  const ActiveContact contact = balls.point.state.contacts[0];
  balls.point.state.contacts.clear();
  balls.point.twist << 0.1, 0.3, 0.1, 0, 0, 5, -0.2, -0.2, 0, 1, 0, 0;
  ASSERT_TRUE(equations.complete(balls.point));
  const auto opening = equations.opening(balls.point, contact);
  ASSERT_TRUE(opening);
  const Vec3 v = balls.point.twist.segment<3>(6) - balls.point.twist.head<3>();
  const auto gap = [&](double t) { return (Vec3(0.05, 0, 0) + t * v).norm() - 0.05; };
  EXPECT_NEAR(opening->rate, test::derivative(gap, 2e-4), 1e-10);
  EXPECT_NEAR(opening->acceleration, test::second_derivative(gap, 1e-3), 1e-6);
}

}  // namespace
}  // namespace genu
