// Bodies that touch while they move, against closed forms: falling, sliding, leaving, swinging in a socket.
#include <array>

#include "motion_scene.h"

namespace genu {
namespace {

using test::dynamics;
using test::kG;
using test::kGround;
using test::motion_of;

/// A ball of radius r (m) and its start, with what it can touch.
std::string ball(double r, const Vec3& start, const std::string& surface, const std::string& motion) {
  return "format = 1\nunits = { length = \"m\", angle = \"rad\" }\n" + fmt::format("gravity = [0, 0, {}]\n", -kG) +
         fmt::format(R"([body.ground]
fixed = true
[body.ball]
mass = 0.5
inertia = [{0}, {0}, {0}]
[joint.free]
type = "free"
parent = "ground"
child = "ball"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = {{ x = {1:.17g}, y = {2:.17g}, z = {3:.17g} }}
[surface.skin]
body = "ball"
shape = "sphere"
radius = {4}
[surface.other]
body = "ground"
{5}
[contact.c]
surfaces = ["skin", "other"]
model = "rigid"
{6})",
                     0.4 * 0.5 * r * r, start.x(), start.y(), start.z(), r, surface, motion);
}

double event_time(const ResultTable& events, const std::string& kind) {
  for (std::size_t row = 0; row < events.rows(); ++row)
    if (std::get<std::string>(events.at(row, events.column_index("event"))) == kind)
      return events.number(row, "time_s");
  ADD_FAILURE() << "no event " << kind;
  return 0;
}

TEST(MotionContact, ABallFallsLandsAndStays) {
  constexpr double kRadius = 0.02, kHeight = 0.07;
  const Solution s = motion_of(ball(kRadius, {0, 0, kHeight}, "shape = \"plane\"\n",
                                    dynamics(0.5, 0.05, 1e-9, "\"free.x\" = 0.03, \"free.a\" = 4")));
  const double landing = std::sqrt(2 * (kHeight - kRadius) / kG);
  EXPECT_NEAR(event_time(s.event_rows, "contact_gained"), landing, 1e-10);
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double t = s.poses.number(row, "time_s");
    SCOPED_TRACE(t);
    const bool down = t > landing;
    EXPECT_NEAR(s.poses.number(row, "free.z_mm"), 1e3 * (down ? kRadius : kHeight - kG * t * t / 2), 1e-7);
    EXPECT_NEAR(s.poses.number(row, "c.force_N"), down ? 0.5 * kG : 0, 1e-9);
    EXPECT_NEAR(s.poses.number(row, "c.gap_mm"), s.poses.number(row, "free.z_mm") - 1e3 * kRadius, 1e-7);
    EXPECT_NEAR(s.poses.number(row, "free.x_mm"), 30 * t, 1e-8) << "without friction nothing slows it";
    EXPECT_NEAR(s.poses.number(row, "energy.dissipated_J"), down ? 0.5 * kG * (kHeight - kRadius) : 0, 1e-11);
  }
  EXPECT_LT(s.summary.motion->worst_energy, 1e-12);
}

/// From near the top of a dome it slides until the dome no longer presses: at 2/3 of its height over the centre.
TEST(MotionContact, ABallLeavesADome) {
  constexpr double kRadius = 0.02, kDome = 0.1, kAngle = 0.1;
  const double arm = kRadius + kDome;
  const Vec3 start(arm * std::sin(kAngle), 0, arm * std::cos(kAngle));
  const Solution s = motion_of(ball(kRadius, start, "shape = \"sphere\"\nradius = 0.1\n", dynamics(0.4, 0.01, 1e-10)));
  const double leaving = event_time(s.event_rows, "contact_lost");
  bool flew = false;
  const double height = 2.0 / 3 * start.z(), cosine = height / arm;
  const double speed = std::sqrt(2 * kG * (start.z() - height));
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double t = s.poses.number(row, "time_s"), x = s.poses.number(row, "free.x_mm") / 1e3,
                 z = s.poses.number(row, "free.z_mm") / 1e3;
    SCOPED_TRACE(t);
    if (t < leaving) {
      EXPECT_NEAR(std::hypot(x, z), arm, 1e-12);
      EXPECT_NEAR(s.poses.number(row, "c.force_N"), 0.5 * kG * (3 * z / arm - 2 * std::cos(kAngle)), 1e-8);
      continue;
    }
    flew = true;
    const double tau = t - leaving;
    EXPECT_NEAR(z, height - speed * std::sqrt(1 - cosine * cosine) * tau - kG * tau * tau / 2, 1e-9);
    EXPECT_NEAR(x, arm * std::sqrt(1 - cosine * cosine) + speed * cosine * tau, 1e-9);
    EXPECT_EQ(s.poses.number(row, "c.force_N"), 0);
  }
  EXPECT_TRUE(flew);
}

/// In a socket it is a pendulum whose arm is the difference of the radii: elliptic functions.
TEST(MotionContact, ABallSwingsInASocket) {
  constexpr double kRadius = 0.02, kSocket = 0.06, kStart = 1.2;  // rad from the lowest point
  const double arm = kSocket - kRadius, omega = std::sqrt(kG / arm), k = std::sin(kStart / 2);
  const Vec3 start(arm * std::sin(kStart), 0, -arm * std::cos(kStart));
  const Solution s =
      motion_of(ball(kRadius, start, "shape = \"sphere\"\nradius = 0.06\ninside = true\n", dynamics(1, 0.02, 1e-10)));
  EXPECT_EQ(s.event_rows.rows(), 0u) << "the socket presses all the time";
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double u = omega * s.poses.number(row, "time_s") + std::comp_ellint_1(k);
    const double angle = 2 * std::asin(k * std::sin(test::amplitude(u, k)));
    EXPECT_NEAR(s.poses.number(row, "free.x_mm"), 1e3 * arm * std::sin(angle), 1e-6);
    EXPECT_NEAR(s.poses.number(row, "c.force_N"), 0.5 * kG * (3 * std::cos(angle) - 2 * std::cos(kStart)), 1e-7);
  }
  EXPECT_LT(s.summary.motion->worst_energy, 1e-9 * s.summary.motion->energy_scale);
}

/// Three feet land one after the other; each lands for good, and at rest they share the weight as levers say.
TEST(MotionContact, AStoolLandsOnThreeFeet) {
  const std::vector<Vec3> feet = {{0.2, 0, 0}, {-0.1, 0.15, 0}, {-0.1, -0.15, 0}};
  const std::string text = test::stool({0.02, 0.01, 0.1}, {0.05, 0.05, 0.03}, "a = 0.02, b = 0.03, z = 0.06", feet);
  const Solution s = motion_of(text + dynamics(1.5, 0.1, 1e-8));
  const std::size_t last = s.poses.rows() - 1;
  double weight = 0, about_x = 0, about_y = 0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const double force = s.poses.number(last, fmt::format("c{}.force_N", i));
    EXPECT_GT(force, 1);
    weight += force;
    about_x += force * feet[i].y();
    about_y += force * feet[i].x();
  }
  EXPECT_NEAR(weight, 3 * kG, 1e-7);
  EXPECT_NEAR(about_x, 3 * kG * 0.01, 1e-7);
  EXPECT_NEAR(about_y, 3 * kG * 0.02, 1e-7);
  EXPECT_NEAR(s.poses.number(last, "free.a_deg"), 0, 1e-8);
  EXPECT_NEAR(s.poses.number(last, "free.z_mm"), 20, 1e-8);
  EXPECT_NEAR(s.poses.number(last, "energy.kinetic_J"), 0, 1e-9) << "slides neither: nothing has pushed it aside";
  EXPECT_LT(s.summary.motion->worst_energy, 1e-7 * s.summary.motion->energy_scale);
}

/// Thrown up it would turn back a hair beyond the ceiling, in the middle of a step as long as the flight.
TEST(MotionContact, AGrazedCeilingIsFelt) {
  constexpr double kRadius = 0.02, kRise = 0.03;
  const double speed = std::sqrt(2 * kG * kRise);
  for (const double beyond : {5e-3, 2e-4, 1e-5, 1e-6}) {
    SCOPED_TRACE(beyond);
    const std::string ceiling =
        fmt::format("shape = \"plane\"\norigin = [0, 0, {:.17g}]\nz_axis = [0, 0, -1]\n", kRise - beyond + kRadius);
    const Solution s = motion_of(
        ball(kRadius, {0, 0, 0}, ceiling, dynamics(0.15, 0.15, 1e-9, fmt::format("\"free.z\" = {:.17g}", speed))));
    ASSERT_GE(s.event_rows.rows(), 1u);
    const double hit = (speed - std::sqrt(2 * kG * beyond)) / kG, since = 0.15 - hit;
    EXPECT_NEAR(event_time(s.event_rows, "contact_gained"), hit, 1e-8);
    EXPECT_NEAR(event_time(s.event_rows, "contact_lost"), hit, 1e-8) << "weight pulls it off at once";
    EXPECT_NEAR(s.poses.number(s.poses.rows() - 1, "free.z_mm"), 1e3 * (kRise - beyond - kG * since * since / 2), 1e-5);
  }
}

TEST(MotionContact, OverlapAtTheStartIsSaid) {
  const Scene scene = test::motion_scene(ball(0.02, {0, 0, 0.019}, "shape = \"plane\"\n", dynamics(1, 0.1, 1e-9)));
  const Solution s = solve_motion(test::prepared_motion(scene), {});
  EXPECT_EQ(s.summary.poses_solved, 0);
  EXPECT_NE(s.summary.verdict.front().find("contact.c overlap by 1 mm at the start"), std::string::npos)
      << s.summary.verdict.front();
}

/// A fast ball does not pass through a thin body between two looks.
TEST(MotionContact, NothingIsSteppedThrough) {
  std::string text = ball(0.001, {0, 0, 0.9}, "shape = \"ellipsoid\"\nradii = [0.05, 0.05, 0.0005]\n",
                          dynamics(1, 1, 1e-6, "\"free.z\" = -30"));
  text.erase(text.find("gravity"), text.find("[body.ground]") - text.find("gravity"));
  const Solution s = motion_of(text);
  EXPECT_NEAR(event_time(s.event_rows, "contact_gained"), (0.9 - 0.0015) / 30, 1e-9);
  EXPECT_NEAR(s.poses.number(1, "free.z_mm"), 1.5, 1e-6) << "inelastic: it stays";
}

/// A ball that drops on an elastic layer rises as high as it was: the foundation stores what it takes.
TEST(MotionContact, AnElasticLayerGivesBack) {
  std::string text = ball(0.02, {0, 0, 0.025}, "shape = \"plane\"\n", dynamics(0.08, 0.001, 1e-5));
  text.replace(text.find("model = \"rigid\""), 15,
               "model = \"cartilage\"\nmodulus = 1\npoisson = 0.3\nthickness = 0.004\ntolerance = 1e-4");
  const Solution s = motion_of(text);
  double pressed = 0, lowest = 1, highest_after = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double z = s.poses.number(row, "free.z_mm");
    pressed = std::max(pressed, s.poses.number(row, "c.force_N"));
    lowest = std::min(lowest, z / 1e3);
    if (s.poses.number(row, "time_s") > 0.05) highest_after = std::max(highest_after, z);
  }
  // Winkler: F = pi R M d^2 / h, energy pi R M d^3 / (3 h) = m g (5 mm + d).
  const double modulus = 1e6 * 0.7 / (1.3 * 0.4), k = M_PI * 0.02 * modulus / 0.004;
  double d = 1e-3;
  for (int i = 0; i < 50; ++i) d = std::cbrt(3 * 0.5 * kG * (0.005 + d) / k);
  EXPECT_NEAR(0.02 - lowest, d, 0.01 * d);
  EXPECT_NEAR(pressed, k * d * d, 0.02 * k * d * d);
  EXPECT_NEAR(highest_after, 25, 0.02) << "mm";
  EXPECT_LT(s.summary.motion->worst_energy, 1e-3 * s.summary.motion->energy_scale);
}

/// One that is damped gives back less: m z'' = k d^2 (1 + c d') - m g.
TEST(MotionContact, ADampedLayerGivesBackLess) {
  constexpr double kDamping = 1.5;
  std::string text = ball(0.02, {0, 0, 0.025}, "shape = \"plane\"\n", dynamics(0.08, 0.0005, 1e-5));
  text.replace(text.find("model = \"rigid\""), 15,
               fmt::format("model = \"cartilage\"\nmodulus = 1\npoisson = 0.3\nthickness = 0.004\ntolerance = 1e-4\n"
                           "damping = {}",
                           kDamping));
  const Solution s = motion_of(text);
  const double modulus = 1e6 * 0.7 / (1.3 * 0.4), k = M_PI * 0.02 * modulus / 0.004;
  double d = 0, rate = std::sqrt(2 * kG * 0.005), strongest = 0;  // Euler's method, finely
  for (constexpr double kStep = 1e-8; d >= 0;) {
    const double force = k * d * d * std::max(0.0, 1 + kDamping * rate);
    strongest = std::max(strongest, force);
    rate += kStep * (kG - force / 0.5);
    d += kStep * rate;
  }
  double pressed = 0, highest = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    pressed = std::max(pressed, s.poses.number(row, "c.force_N"));
    if (s.poses.number(row, "time_s") > 0.045) highest = std::max(highest, s.poses.number(row, "free.z_mm"));
  }
  const double rise = rate * rate / (2 * kG);
  EXPECT_LT(rise, 0.004);
  EXPECT_NEAR(highest, 20 + 1e3 * rise, 0.05) << "mm";
  EXPECT_NEAR(pressed, strongest, 0.02 * strongest);
  EXPECT_NEAR(s.poses.number(s.poses.rows() - 1, "energy.dissipated_J"), 0.5 * kG * (0.005 - rise), 5e-4);
  EXPECT_LT(s.summary.motion->worst_energy, 1e-3 * s.summary.motion->energy_scale);
}

}  // namespace
}  // namespace genu
