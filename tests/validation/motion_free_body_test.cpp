// Bodies that fly: conserved quantities and closed forms.
#include "genu/motion/motion_rates.h"
#include "motion_scene.h"

namespace genu {
namespace {

using test::dynamics;
using test::kGround;
using test::motion_of;
using test::motion_scene;

std::string free_body(const std::string& name, const std::string& properties, const std::string& start = "{}") {
  return fmt::format(R"([body.{0}]
{1}
[joint.{0}_in]
type = "free"
parent = "ground"
child = "{0}"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
start = {2}
)",
                     name, properties, start);
}

TEST(MotionFreeBody, ATopKeepsEnergyAndMomentum) {
  // Turning about its middle axis, which tumbles over, with the centre of mass off the origin.
  const Scene scene = motion_scene(
      kGround +
      free_body("top",
                "mass = 1.5\ncentre_of_mass = [0.1, -0.05, 0.2]\ninertia = [0.02, 0.03, 0.04, 0.002, 0, 0.001]") +
      dynamics(10, 0.1, 1e-11, "\"top_in.a\" = 0.02, \"top_in.b\" = 6, \"top_in.c\" = 0.03, \"top_in.x\" = 0.5"));
  ASSERT_TRUE(scene.dynamics);
  const Prepared p = test::prepared_motion(scene);
  const Inertia& inertia = p.model.inertias[0];
  std::vector<MotionPoint> points;
  const MotionResult result = follow_motion(p.model, plan_motion(*scene.dynamics),
                                            {[&](const MotionPoint& m) { points.push_back(m); }, {}, {}});
  ASSERT_TRUE(result.complete) << result.why;
  Vec3 first_momentum = Vec3::Zero(), first_centre = Vec3::Zero(), first_speed = Vec3::Zero();
  double worst_momentum = 0, worst_energy = 0, worst_line = 0, first_energy = 0, least = 1;
  for (const MotionPoint& m : points) {
    const Mat3& R = m.state.poses[1].R;
    const Vec3 w = m.twist.tail<3>(), c = R * inertia.centre_of_mass;
    const Vec3 spin = R * inertia.about_centre_of_mass * R.transpose() * w;
    const Vec3 centre = m.state.poses[1].p + c, speed = Vec3(m.twist.head<3>()) + w.cross(c);
    const double energy = 0.5 * (inertia.mass * speed.squaredNorm() + w.dot(spin));
    if (m.time == 0) first_momentum = spin, first_centre = centre, first_speed = speed, first_energy = energy;
    worst_momentum = std::max(worst_momentum, (spin - first_momentum).norm() / first_momentum.norm());
    worst_energy = std::max(worst_energy, std::abs(energy - first_energy) / first_energy);
    worst_line = std::max(worst_line, (centre - first_centre - m.time * first_speed).norm());
    least = std::min(least, m.state.poses[1].R(1, 1));
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-14);
  }
  EXPECT_LT(least, -0.9) << "it turns over";
  EXPECT_LT(worst_momentum, 1e-9);
  EXPECT_LT(worst_energy, 1e-9);
  EXPECT_LT(worst_line, 1e-9) << "m, of the centre of mass from its straight line";
}

TEST(MotionFreeBody, TwoOnASpringWithADamper) {
  constexpr double kA = 1.2, kB = 0.8, kStiffness = 90, kDamping = 1.5, kRest = 0.3, kSpeed = 0.7;
  const std::string body = "inertia = [0.01, 0.01, 0.01]\nmass = ";
  const Solution s = motion_of(kGround + free_body("a", body + std::to_string(kA)) +
                               free_body("b", body + std::to_string(kB), "{ x = 0.4 }") +
                               fmt::format(R"([ligament.spring]
from = {{ body = "a", point = [0, 0, 0] }}
to = {{ body = "b", point = [0, 0, 0] }}
law = "spring"
stiffness = {}
damping = {}
slack_length = {}
)",
                                           kStiffness, kDamping, kRest) +
                               dynamics(4, 0.05, 1e-11, fmt::format("\"b_in.x\" = {}", kSpeed)));
  const double mass = kA * kB / (kA + kB), delta = kDamping / (2 * mass);
  const double omega = std::sqrt(kStiffness / mass - delta * delta), drift = kB * kSpeed / (kA + kB);
  double worst = 0, worst_force = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double t = s.poses.number(row, "time_s"), decay = std::exp(-delta * t);
    constexpr double kFirst = 0.1;  // of the stretch
    const double sine = (kSpeed + delta * kFirst) / omega;
    const double stretch = decay * (kFirst * std::cos(omega * t) + sine * std::sin(omega * t));
    const double rate = -delta * stretch + decay * omega * (-kFirst * std::sin(omega * t) + sine * std::cos(omega * t));
    const double centre = (kB * 0.4) / (kA + kB) + drift * t;
    worst = std::max(worst, std::abs(s.poses.number(row, "spring.length_mm") * 1e-3 - kRest - stretch));
    worst = std::max(worst, std::abs((kA * s.poses.number(row, "a_in.x_mm") + kB * s.poses.number(row, "b_in.x_mm")) *
                                         1e-3 / (kA + kB) -
                                     centre));
    worst_force =
        std::max(worst_force, std::abs(s.poses.number(row, "spring.force_N") - kStiffness * stretch - kDamping * rate));
  }
  EXPECT_LT(worst, 1e-10) << "m";
  EXPECT_LT(worst_force, 1e-8) << "N";
  EXPECT_LT(s.summary.motion->worst_energy, 1e-9);
}

TEST(MotionFreeBody, ATetherWithADamperGoesTautAndSlack) {
  // Flies out, is caught by the tether, let go where tether and damper would push, and flies back slack.
  constexpr double kMass = 0.5, kStiffness = 200, kDamping = 3, kSlack = 0.5, kSpeed = 1.1;
  const Solution s = motion_of(
      kGround +
      free_body("ball", "mass = 0.5\ninertia = [0.001, 0.001, 0.001]", "{ x = 0.4 }\nreference = { x = 0.4 }") +
      fmt::format(R"([ligament.tether]
from = {{ body = "ground", point = [0, 0, 0] }}
to = {{ body = "ball", point = [0, 0, 0] }}
law = "linear"
stiffness = {}
damping = {}
slack_length = {}
)",
                  kStiffness * kSlack, kDamping, kSlack) +
      dynamics(0.8, 0.01, 1e-11, fmt::format("\"ball_in.x\" = {}", kSpeed)));
  const double caught = 0.1 / kSpeed, delta = kDamping / (2 * kMass);
  const double omega = std::sqrt(kStiffness / kMass - delta * delta);
  const double held = (std::numbers::pi - std::atan(kDamping * omega / (kStiffness - kDamping * delta))) / omega;
  const auto stretch = [&](double t) { return kSpeed / omega * std::exp(-delta * t) * std::sin(omega * t); };
  const auto rate = [&](double t) {
    return kSpeed * std::exp(-delta * t) * (std::cos(omega * t) - delta / omega * std::sin(omega * t));
  };
  double worst = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double t = s.poses.number(row, "time_s"), after = t - caught;
    const double x = after < 0      ? 0.4 + kSpeed * t
                     : after < held ? kSlack + stretch(after)
                                    : kSlack + stretch(held) + rate(held) * (after - held);
    worst = std::max(worst, std::abs(s.poses.number(row, "ball_in.x_mm") * 1e-3 - x));
    EXPECT_GE(s.poses.number(row, "tether.force_N"), -1e-9) << "a tether does not push, at " << t;
  }
  EXPECT_LT(worst, 1e-9) << "m";
  EXPECT_LT(s.summary.motion->worst_energy, 1e-9);
  ASSERT_EQ(s.events.size(), 3u);
  EXPECT_NEAR(s.events[0].target.time, caught, 1e-10);
  EXPECT_NEAR(s.events[1].target.time, caught + held, 1e-10);
  EXPECT_NEAR(s.events[2].target.time, caught + held - stretch(held) / rate(held), 1e-9);
}

TEST(MotionFreeBody, ATetherThatIsJustTautAtTheStart) {
  // At rest where its law breaks, then pulled on: which side it is on shows only when it has moved.
  constexpr double kMass = 0.5, kStiffness = 200, kForce = 6, kSlack = 0.5;
  for (const double sign : {1.0, -1.0}) {
    const Solution s = motion_of(
        kGround +
        free_body("ball", "mass = 0.5\ninertia = [0.001, 0.001, 0.001]", "{ x = 0.5 }\nreference = { x = 0.5 }") +
        fmt::format(R"([ligament.tether]
from = {{ body = "ground", point = [0, 0, 0] }}
to = {{ body = "ball", point = [0, 0, 0] }}
law = "linear"
stiffness = {}
slack_length = {}
[load.pull]
body = "ball"
force = [{}, 0, 0]
)",
                    kStiffness * kSlack, kSlack, sign * kForce) +
        dynamics(0.15, 0.01, 1e-10));
    const double omega = std::sqrt(kStiffness / kMass);
    double worst = 0;
    for (std::size_t row = 0; row < s.poses.rows(); ++row) {
      const double t = s.poses.number(row, "time_s");
      const double taut = kForce / kStiffness * (1 - std::cos(omega * t)), slack = -0.5 * kForce / kMass * t * t;
      worst =
          std::max(worst, std::abs(s.poses.number(row, "ball_in.x_mm") * 1e-3 - kSlack - (sign > 0 ? taut : slack)));
    }
    EXPECT_LT(worst, 1e-10) << "m, pulled " << (sign > 0 ? "taut" : "slack");
  }
}

}  // namespace
}  // namespace genu
