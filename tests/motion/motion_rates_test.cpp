#include "genu/motion/motion_rates.h"

#include <gtest/gtest.h>

#include "genu/model/build_model.h"
#include "genu/model/damping.h"
#include "genu/model/linearization.h"
#include "support/scene_model.h"

namespace genu {
namespace {

constexpr double kTimeStep = 1e-4;

const std::string kChain = R"(format = 1
units = { length = "mm", angle = "rad" }
gravity = [0, -9.81, 0]
[body.ground]
fixed = true
[body.bone]
mass = 2
centre_of_mass = [10, -80, 5]
inertia = [0.02, 0.01, 0.015]
[body.tip]
mass = 1
centre_of_mass = [3, 2, 40]
inertia = [0.002, 0.001, 0.0015]
[joint.j]
type = "free"
parent = "ground"
child = "bone"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
start = { a = 0.4, b = -0.7, c = 1.1, x = 20, y = 5 }
[joint.h]
type = "revolute"
parent = "bone"
child = "tip"
origin = [10, 20, -30]
axis = [1, 2, -1]
damping = 0.4
start = { angle = 0.6 }
[ligament.cord]
from = { body = "ground", point = [50, 0, 0] }
via = [{ body = "bone", point = [0, 30, 10] }]
to = { body = "tip", point = [5, -50, 20] }
law = "spring"
stiffness = 2
damping = 0.3
slack_length = 80
[load.push]
body = "tip"
force = [3, -2, 5]
moment = [0.1, 0.2, -0.3]
point = [4, 5, 6]
frame = "body"
[dynamics]
duration = 1
output_interval = 1
)";

struct Moving {
  Moving() {
    Diagnostics out;
    auto scene = parse_scene(kChain, "s", out);
    for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
    model = *build_model(place(*scene), {}, out);
    state = start_state(model);
    state.multipliers.assign(model.held.size(), 0);
    twist.resize(12);
    twist << 0.1, -0.3, 0.2, 1, 2, -1.5, -0.4, 0.2, 0.1, 0.5, -1, 2;
    target.load_factors.assign(1, 1.0);
  }
  /// The state after the time t at this twist.
  State after(double t) const {
    Correction c;
    c.resize(2, static_cast<int>(model.held.size()), 0);
    c.twist = twist;
    c.multipliers.setZero();
    State out;
    EXPECT_TRUE(retract(model, state, c, t, out));
    return out;
  }
  JointModel model;
  State state;
  VecX twist;
  Target target;
};

TEST(MotionRates, OfCoordinatesAndOfWhatJointsHold) {
  const Moving m;
  const auto rates = coordinate_rates(m.model, m.state, m.twist);
  const State before = m.after(-kTimeStep), after = m.after(kTimeStep);
  double worst = 0;
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t i = 0; i < 6; ++i)
      worst = std::max(worst,
                       std::abs((after.coordinates[j][i] - before.coordinates[j][i]) / (2 * kTimeStep) - rates[j][i]));
  EXPECT_LT(worst, 1e-6);
  Linearization ahead, behind;
  linearize_constraints(m.model, after, m.target, ahead);
  linearize_constraints(m.model, before, m.target, behind);
  const VecX numeric = (ahead.gradient - behind.gradient) * m.twist / (2 * kTimeStep);
  const VecX exact = centripetal_rates(m.model, m.state, {}, m.twist);
  ASSERT_EQ(exact.size(), 5);
  EXPECT_LT((numeric - exact).norm(), 1e-6 * exact.norm()) << exact.transpose();
}

TEST(MotionRates, TheConstraintsAloneAreThoseOfTheWholeSystem) {
  const Moving m;
  Linearization whole, alone;
  linearize(m.model, m.state, m.target, whole);
  linearize_constraints(m.model, m.state, m.target, alone);
  EXPECT_EQ(whole.gradient, alone.gradient);
  EXPECT_EQ(whole.constraint, alone.constraint);
}

TEST(MotionRates, EnergiesChangeByThePowerOfTheForces) {
  // All forces of the quasi-static system: the load's power less what is stored.
  const Moving m;
  Linearization at;
  linearize(m.model, m.state, m.target, at);
  const auto potential = [&](double t) {
    const MechanicalEnergy e = mechanical_energy(m.model, m.after(t), m.twist);
    return e.stored + e.gravity;
  };
  const double lost = -(potential(kTimeStep) - potential(-kTimeStep)) / (2 * kTimeStep);
  const double power = load_power(m.model, m.state, m.target, m.twist);
  EXPECT_NEAR(at.wrench.dot(m.twist), lost + power, 1e-6 * std::abs(lost));
  EXPECT_GT(std::abs(power), 0.1);
}

TEST(MotionRates, DampersTakeWhatTheirWrenchesDo) {
  const Moving m;
  VecX wrench = VecX::Zero(12);
  const double power = add_damping(m.model, m.state, damper_modes(m.model, m.state, m.twist), m.twist, wrench);
  EXPECT_NEAR(-wrench.dot(m.twist), power, 1e-13 * power);
  const auto length = [&](double t) {
    const State s = m.after(t);
    const Vec3 via = s.poses[1] * Vec3(0, 0.03, 0.01);
    return (via - Vec3(0.05, 0, 0)).norm() + (s.poses[2] * Vec3(0.005, -0.05, 0.02) - via).norm();
  };
  const double rate = (length(kTimeStep) - length(-kTimeStep)) / (2 * kTimeStep);
  const double turn = coordinate_rates(m.model, m.state, m.twist)[1][0];
  EXPECT_NEAR(power, 300 * rate * rate + 0.4 * turn * turn, 1e-6 * power);
}

}  // namespace
}  // namespace genu
