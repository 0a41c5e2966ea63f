// A contact that stays closed: its gap against the geometry's own, its derivatives against difference quotients.
#include "genu/model/closed_contact.h"

#include <fmt/format.h>

#include "support/finite_difference.h"
#include "support/scene_model.h"

namespace genu {
namespace {

std::string pair_of(const std::string& a, const std::string& b) {
  return R"(format = 1
units = { length = "mm", angle = "rad" }
[body.ground]
fixed = true
[body.one]
[body.two]
[joint.j]
type = "free"
parent = "ground"
child = "one"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { a = 0.2, b = -0.1, z = 3 }
[joint.k]
type = "free"
parent = "one"
child = "two"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { a = 0.1, b = 0.3, c = 0.2, x = 4, z = 45 }
[surface.A]
body = "one"
)" + a + "[surface.B]\nbody = \"two\"\n" +
         b + "[contact.c]\nsurfaces = [\"A\", \"B\"]\nmodel = \"rigid\"\n";
}

/// Both bodies after steps along two twists.
State moved(const JointModel& model, const State& state, const VecX& twist) {
  State out = state;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (const int k = model.bodies[i].moving; k >= 0)
      out.poses[i] = retract(state.poses[i], Vec6(twist.segment<6>(6 * k)));
  return out;
}

ActiveContact first_contact(const JointModel& model, const State& state) {
  ActiveContact contact;
  const auto& pair = model.pairs[0];
  const Pose &a = state.poses[static_cast<std::size_t>(pair.body_a)],
             &b = state.poses[static_cast<std::size_t>(pair.body_b)];
  EXPECT_TRUE(pair.a->project(a.inverse() * b.p, contact.geometry.a));
  EXPECT_TRUE(pair.b->project(b.inverse() * (a * contact.geometry.a.p), contact.geometry.b));
  return contact;
}

void expect_derivatives(const std::string& text, double length) {
  const test::SceneModel scene = test::scene_model(text);
  const State state = reference_state(scene.model);
  ActiveContact contact = first_contact(scene.model, state);
  ClosedContact closed;
  ASSERT_TRUE(evaluate_closed(scene.model, state, contact, closed));
  VecX twist(12);
  twist << 0.02, -0.01, 0.03, 1, -2, 0.5, -0.03, 0.01, 0.02, -1, 0.7, 2;
  const auto at = [&](double s) {
    ActiveContact there = contact;
    ClosedContact out;
    EXPECT_TRUE(evaluate_closed(scene.model, moved(scene.model, state, s * twist), there, out));
    return out;
  };
  const Vec12 pair = twist_at(scene.model, contact, twist);
  const double rate = test::derivative([&](double s) { return at(s).gap; }, 1e-3);
  EXPECT_NEAR(closed.gradient.dot(pair), rate, 1e-9 * length) << "gap " << closed.gap;
  MatX row(1, 12);
  set_row(scene.model, contact, closed.gradient, 0, row);
  EXPECT_NEAR(row.row(0).dot(twist), rate, 1e-9 * length);
  if (std::abs(closed.gap) > 1e-12) return;  // it is for closed contacts that the wrench is the gradient
  const Vec12 change = test::derivative([&](double s) { return Vec12(at(s).gradient); }, 1e-3);
  EXPECT_LT((closed.curvature * pair - change).norm(), 1e-7);
}

const std::string kTorus =
    "shape = \"torus\"\nmajor_radius = 15\nminor_radius = 5\nz_axis = [1, 0, 0]\nx_axis = [0, 1, 0]\n";
const std::string kEllipsoid = "shape = \"ellipsoid\"\nradii = [30, 20, 24]\n";

TEST(ClosedContact, GapAndItsRate) { expect_derivatives(pair_of(kEllipsoid, kTorus), 1); }

/// The same pair, brought together.
TEST(ClosedContact, GradientsTurnAsTheCurvatureSays) {
  std::string text = pair_of(kEllipsoid, kTorus);
  const test::SceneModel apart = test::scene_model(text);
  State state = reference_state(apart.model);
  ActiveContact contact = first_contact(apart.model, state);
  ClosedContact closed;
  for (int i = 0; i < 20; ++i) {  // body two along the normal until the gap is gone
    ASSERT_TRUE(evaluate_closed(apart.model, state, contact, closed));
    state.poses[2].p -= closed.gap * closed.gradient.segment<3>(6);
  }
  ASSERT_LT(std::abs(closed.gap), 1e-15);
  const Pose X = state.poses[1].inverse() * state.poses[2];
  const std::string together =
      fmt::format("x = {:.17g}, y = {:.17g}, z = {:.17g}", 1e3 * X.p.x(), 1e3 * X.p.y(), 1e3 * X.p.z());
  text.replace(text.find("x = 4, z = 45"), 13, together);
  expect_derivatives(text, 1);
}

TEST(ClosedContact, SphereOnPlaneInClosedForm) {
  const test::SceneModel scene = test::scene_model(pair_of("shape = \"plane\"\n", "shape = \"sphere\"\nradius = 20\n"));
  const State state = reference_state(scene.model);
  ActiveContact contact = first_contact(scene.model, state);
  ClosedContact closed;
  ASSERT_TRUE(evaluate_closed(scene.model, state, contact, closed));
  EXPECT_NEAR(closed.gap, 0.025, 1e-16) << "in the plane's own frame: 45 - 20 mm";
  EXPECT_NEAR((closed.gradient.segment<3>(6) - state.poses[1].R.col(2)).norm(), 0, 1e-15);
  EXPECT_NEAR(closed.gradient.tail<3>().norm(), 0, 1e-15) << "turning a sphere opens nothing";
}

TEST(ClosedContact, PlanesHaveNoNearestPoint) {
  test::SceneModel scene = test::scene_model(pair_of("shape = \"plane\"\n", "shape = \"sphere\"\nradius = 20\n"));
  scene.model.pairs[0].b = make_plane(Pose{}, false);
  ActiveContact contact;
  const State state = reference_state(scene.model);
  ASSERT_TRUE(scene.model.pairs[0].a->project(Vec3::Zero(), contact.geometry.a));
  ASSERT_TRUE(scene.model.pairs[0].b->project(Vec3::Zero(), contact.geometry.b));
  ClosedContact closed;
  EXPECT_FALSE(evaluate_closed(scene.model, state, contact, closed));
}

}  // namespace
}  // namespace genu
