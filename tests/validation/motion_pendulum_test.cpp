// Bodies that swing on hinges, against elliptic functions, closed forms and Lagrange's equations.
#include <array>

#include "motion_scene.h"

namespace genu {
namespace {

using test::dynamics;
using test::kG;
using test::kGround;
using test::kPerDegree;
using test::motion_of;

constexpr double kLinkMass = 2, kLinkArm = 0.4,
                 kLinkInertia = 0.05;  // the hinge does not go through the centre of mass
const double kOmega = std::sqrt(kLinkMass * kG * kLinkArm / (kLinkInertia + kLinkMass * kLinkArm * kLinkArm));

std::string pendulum(double start, const std::string& dynamics_text) {
  return kGround +
         fmt::format(R"([body.link]
mass = {}
centre_of_mass = [0, {}, 0.3]
inertia = [0.06, 0.04, {}, 0.004, -0.002, 0.001]
[joint.h]
type = "revolute"
parent = "ground"
child = "link"
origin = [0.1, -0.2, 0.05]
axis = [0, 0, 1]
start = {{ angle = {} }}
)",
                     kLinkMass, -kLinkArm, kLinkInertia, start) +
         dynamics_text;
}
std::string with_gravity(std::string text) {
  return text.insert(text.find("[body.ground]"), fmt::format("gravity = [0, {}, 0]\n", -kG));
}

double worst_swing(const ResultTable& t, double start) {
  const double k = std::sin(start / 2), quarter = std::comp_ellint_1(k);
  double worst = 0;
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const double u = kOmega * t.number(row, "time_s") + quarter;
    const double angle = 2 * std::asin(k * std::sin(test::amplitude(u, k)));
    worst = std::max(worst, std::abs(t.number(row, "h.angle_deg") * kPerDegree - angle));
  }
  return worst;
}

TEST(MotionPendulum, SwingsAsTheEllipticFunctionsSay) {
  constexpr double kStart = 2.6;  // rad: 149 deg
  const double period = 4 * std::comp_ellint_1(std::sin(kStart / 2)) / kOmega;
  const Solution s = motion_of(with_gravity(pendulum(kStart, dynamics(3 * period, period / 40, 1e-11))));
  ASSERT_EQ(s.poses.rows(), 121u);
  EXPECT_LT(worst_swing(s.poses, kStart), 5e-10) << "rad";
  EXPECT_NEAR(s.poses.number(120, "h.angle_deg") * kPerDegree, kStart, 1e-9) << "after three periods";
  EXPECT_NEAR(s.poses.number(20, "h.angle_deg") * kPerDegree, -kStart, 1e-9) << "after half of one";
  EXPECT_LT(s.summary.motion->worst_energy, 1e-9 * s.summary.motion->energy_scale);
  // At rest on its highest point the hinge carries what is left of the weight.
  const double fall = kOmega * kOmega * std::sin(kStart) * kLinkArm;  // of the centre of mass, across the arm
  EXPECT_NEAR(s.poses.number(0, "h.reaction.force_x_N"), -kLinkMass * fall * std::cos(kStart), 1e-9);
  EXPECT_NEAR(s.poses.number(0, "h.reaction.force_y_N"), kLinkMass * (kG - fall * std::sin(kStart)), 1e-9);
}

TEST(MotionPendulum, TurnsOverAndOver) {
  const double rate = 2.2 * kOmega, k = 2 * kOmega / rate;  // just over the top
  const Solution s =
      motion_of(with_gravity(pendulum(0, dynamics(10, 0.05, 1e-11, fmt::format("\"h.angle\" = {:.17g}", rate)))));
  double worst = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row)
    worst = std::max(worst, std::abs(s.poses.number(row, "h.angle_deg") * kPerDegree -
                                     2 * test::amplitude(rate * s.poses.number(row, "time_s") / 2, k)));
  EXPECT_GT(s.poses.number(s.poses.rows() - 1, "h.angle_deg"), 3 * 360);
  EXPECT_LT(worst, 2e-8) << "rad, after many turns";
}

TEST(MotionPendulum, TheErrorFallsWithTheTolerance) {
  double last = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const double worst = worst_swing(motion_of(with_gravity(pendulum(1.5, dynamics(5, 0.1, tolerance)))).poses, 1.5);
    EXPECT_LT(worst, 10 * tolerance) << "rad, at " << tolerance;
    EXPECT_LT(worst, last / 10) << "at " << tolerance;
    last = worst;
  }
}

TEST(MotionPendulum, ADampedTorsionSpring) {
  constexpr double kStiffness = 3, kDamping = 0.2, kStart = 0.8;
  std::string text = pendulum(kStart, dynamics(6, 0.05, 1e-11));
  text.insert(text.find("[dynamics]"), fmt::format("stiffness = {}\ndamping = {}\n", kStiffness, kDamping));
  const Solution s = motion_of(text);
  const double inertia = kLinkInertia + kLinkMass * kLinkArm * kLinkArm, delta = kDamping / (2 * inertia);
  const double omega = std::sqrt(kStiffness / inertia - delta * delta);
  double worst = 0, worst_rate = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double t = s.poses.number(row, "time_s"), decay = kStart * std::exp(-delta * t);
    const double angle = decay * (std::cos(omega * t) + delta / omega * std::sin(omega * t));
    const double rate = -decay * (omega + delta * delta / omega) * std::sin(omega * t);
    worst = std::max(worst, std::abs(s.poses.number(row, "h.angle_deg") * kPerDegree - angle));
    worst_rate = std::max(worst_rate, std::abs(s.poses.number(row, "h.angle_velocity_deg_s") * kPerDegree - rate));
  }
  EXPECT_LT(worst, 1e-10) << "rad";
  EXPECT_LT(worst_rate, 1e-9) << "rad/s";
  const std::size_t end = s.poses.rows() - 1;
  const double lost = 0.5 * kStiffness * kStart * kStart - s.poses.number(end, "energy.kinetic_J") -
                      s.poses.number(end, "energy.stored_J");
  EXPECT_NEAR(s.poses.number(end, "energy.dissipated_J"), lost, 1e-9);
}

/// Lagrange's equations of two physical pendulums, angles from the vertical.
struct Links {
  double m1 = 3, c1 = 0.16, I1 = 0.02, length = 0.3, m2 = 2, c2 = 0.2, I2 = 0.015;
  std::array<long double, 4> rate(const std::array<long double, 4>& y) const {
    const long double d = y[0] - y[1], couple = m2 * length * c2;
    const long double a = I1 + m1 * c1 * c1 + m2 * length * length, b = couple * cosl(d), e = I2 + m2 * c2 * c2;
    const long double f = -couple * sinl(d) * y[3] * y[3] - (m1 * c1 + m2 * length) * kG * sinl(y[0]);
    const long double g = couple * sinl(d) * y[2] * y[2] - m2 * c2 * kG * sinl(y[1]);
    return {y[2], y[3], (f * e - b * g) / (a * e - b * b), (a * g - b * f) / (a * e - b * b)};
  }
  void step(std::array<long double, 4>& y, long double h) const {
    const auto at = [&](const std::array<long double, 4>& k, long double by) {
      std::array<long double, 4> out = y;
      for (std::size_t i = 0; i < 4; ++i) out[i] += by * k[i];
      return out;
    };
    const auto k1 = rate(y), k2 = rate(at(k1, h / 2)), k3 = rate(at(k2, h / 2)), k4 = rate(at(k3, h));
    for (std::size_t i = 0; i < 4; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
};

std::string double_pendulum(double duration, double interval, double tolerance) {
  const Links l;
  return with_gravity(kGround) +
         fmt::format(R"([body.upper]
mass = {}
centre_of_mass = [0, {}, 0]
inertia = [0.02, 0.01, {}]
[body.lower]
mass = {}
centre_of_mass = [0, {}, 0]
inertia = [0.015, 0.01, {}]
[joint.h1]
type = "revolute"
parent = "ground"
child = "upper"
axis = [0, 0, 1]
start = {{ angle = 1.2 }}
[joint.h2]
type = "revolute"
parent = "upper"
child = "lower"
origin = [0, {}, 0]
axis = [0, 0, 1]
start = {{ angle = 0.7 }}
)",
                     l.m1, -l.c1, l.I1, l.m2, -l.c2, l.I2, -l.length) +
         dynamics(duration, interval, tolerance);
}

TEST(MotionPendulum, ADoubleOneAsLagrangesEquationsSay) {
  const Solution s = motion_of(double_pendulum(3, 0.1, 1e-12));
  std::array<long double, 4> y = {1.2L, 1.9L, 0, 0};
  double worst = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double first = s.poses.number(row, "h1.angle_deg") * kPerDegree;
    const double second = first + s.poses.number(row, "h2.angle_deg") * kPerDegree;
    worst =
        std::max({worst, std::abs(first - static_cast<double>(y[0])), std::abs(second - static_cast<double>(y[1]))});
    for (int k = 0; k < 2000; ++k) Links().step(y, 0.1L / 2000);
  }
  EXPECT_LT(worst, 1e-9) << "rad";
}

TEST(MotionPendulum, ADoubleOneKeepsItsEnergy) {
  const Solution s = motion_of(double_pendulum(10, 0.1, 1e-12));
  EXPECT_LT(s.summary.motion->worst_energy, 1e-9 * s.summary.motion->energy_scale);
  EXPECT_GT(s.summary.motion->energy_scale, 1) << "J: a large motion";
}

}  // namespace
}  // namespace genu
