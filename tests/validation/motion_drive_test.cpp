// Coordinates whose motion is given, joints that meet their limits, and slow motion beside equilibrium.
#include "genu/model/step_plan.h"
#include "motion_scene.h"
#include "support/judged.h"
#include "support/knee_scene.h"
#include "support/places.h"

namespace genu {
namespace {

using test::dynamics;
using test::kGround;
using test::motion_of;

constexpr double kArmMass = 2, kArmLength = 0.1, kArmInertia = 0.01;
const double kAbout = kArmInertia + kArmMass * kArmLength * kArmLength;

std::string arm(const std::string& joint, const std::string& motion) {
  return kGround +
         fmt::format("[body.arm]\nmass = {}\ncentre_of_mass = [{}, 0, 0]\ninertia = [{}, {}, {}]\n", kArmMass,
                     kArmLength, 0.001, kArmInertia, kArmInertia) +
         "[joint.h]\ntype = \"revolute\"\nparent = \"ground\"\nchild = \"arm\"\naxis = [0, 0, 1]\n" + joint + motion;
}

TEST(MotionDrive, TheReactionIsWhatTheAccelerationCosts) {
  const Solution s = motion_of(arm("", dynamics(1, 0.05, 1e-10) +
                                           "prescribe = { \"h.angle\" = { sine = { amplitude = 0.5, frequency = 1.5, "
                                           "start = 0.2, offset = 0.1 } } }\n"));
  const double w = 3 * M_PI;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double t = s.poses.number(row, "time_s"), phase = t > 0.2 ? w * (t - 0.2) : 0;
    if (std::abs(t - 0.2) < 1e-9) continue;  // there it jumps
    SCOPED_TRACE(t);
    const double angle = 0.1 + 0.5 * std::sin(phase), rate = t > 0.2 ? 0.5 * w * std::cos(phase) : 0;
    EXPECT_NEAR(s.poses.number(row, "h.angle_deg") * test::kPerDegree, angle, 1e-12);
    EXPECT_NEAR(s.poses.number(row, "h.angle_velocity_deg_s") * test::kPerDegree, rate, 1e-11);
    EXPECT_NEAR(s.poses.number(row, "h.angle.reaction_Nm"), -kAbout * 0.5 * w * w * std::sin(phase), 1e-10);
    EXPECT_NEAR(s.poses.number(row, "energy.load_work_J"), kAbout * rate * rate / 2, 1e-9) << "all of it kinetic";
    // What the hinge carries: the centripetal force, and the tangential one.
    EXPECT_NEAR(std::hypot(s.poses.number(row, "h.reaction.force_x_N"), s.poses.number(row, "h.reaction.force_y_N")),
                kArmMass * kArmLength * std::hypot(rate * rate, 0.5 * w * w * std::sin(phase)), 1e-9);
  }
}

/// At the end of a table the drive stops at once: the impulse takes the kinetic energy back.
TEST(MotionDrive, AKinkIsAnImpulse) {
  const Solution s =
      motion_of(arm("", dynamics(1, 0.25, 1e-9) + "prescribe = { \"h.angle\" = { table = [[0, 0], [0.6, 1.2]] } }\n"));
  for (const std::size_t row : {1u, 2u}) {
    EXPECT_NEAR(s.poses.number(row, "energy.kinetic_J"), kAbout * 2, 1e-10);
    EXPECT_NEAR(s.poses.number(row, "energy.balance_J"), 0, 1e-10);
  }
  EXPECT_NEAR(s.poses.number(4, "energy.kinetic_J"), 0, 1e-20);
  EXPECT_NEAR(s.poses.number(4, "h.angle_deg") * test::kPerDegree, 1.2, 1e-12);
  EXPECT_NEAR(s.poses.number(4, "energy.dissipated_J"), 0, 1e-10) << "the drive has it";
}

/// Two arms, one on the other, whose angles a combination couples: the outer one keeps its direction.
TEST(MotionDrive, ACombinationIsDriven) {
  const std::string text =
      arm("start = { angle = 0.3 }\n", "") +
      "[body.tip]\nmass = 1\ninertia = [0.01, 0.01, 0.01]\n[joint.k]\ntype = \"revolute\"\nparent = \"arm\"\nchild = "
      "\"tip\"\norigin = [0.2, 0, 0]\naxis = [0, 0, 1]\nstart = { angle = -0.3 }\n"
      "[combination.direction]\nterms = { \"h.angle\" = 1, \"k.angle\" = 1 }\n"
      "[load.push]\nbody = \"tip\"\nforce = [0, 0.5, 0]\n" +
      dynamics(0.8, 0.1, 1e-10) + "prescribe = { direction = 0 }\n";
  const Solution s = motion_of(text);
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    EXPECT_NEAR(s.poses.number(row, "direction_deg"), 0, 1e-11);
    // The tip does not turn: a point mass on the arm, and the force's work is what moves.
    const double angle = s.poses.number(row, "h.angle_deg") * test::kPerDegree;
    const double rate = s.poses.number(row, "h.angle_velocity_deg_s") * test::kPerDegree;
    const double work = 0.5 * 0.2 * (std::sin(angle) - std::sin(0.3));
    EXPECT_NEAR((kAbout + 1 * 0.2 * 0.2) * rate * rate / 2, work, 1e-9);
  }
  EXPECT_GT(s.poses.number(8, "h.angle_deg"), 25);
}

TEST(MotionLimit, TheStopGivesBackAfterHalfAPeriodOfItsSpring) {
  const Solution s = motion_of(
      arm("limits = { from = -0.2, to = 0.5, stiffness = 40 }\n", dynamics(2, 0.1, 1e-10, "\"h.angle\" = 3")));
  ASSERT_GE(s.event_rows.rows(), 4u);
  const double inside = M_PI * std::sqrt(kAbout / 40);
  const double passes[] = {0.5 / 3, 0.5 / 3 + inside, 0.5 / 3 + inside + 0.7 / 3, 0.5 / 3 + 2 * inside + 0.7 / 3};
  for (std::size_t row = 0; row < 4; ++row) EXPECT_NEAR(s.event_rows.number(row, "time_s"), passes[row], 1e-8) << row;
  EXPECT_LT(s.summary.motion->worst_energy, 1e-8 * s.summary.motion->energy_scale);
}

/// Each crossing is one event, wherever rounding leaves the angle when the integration begins anew there.
TEST(MotionLimit, IsPassedOnceAtATime) {
  for (int k = 0; k < 60; ++k) {
    SCOPED_TRACE(k);
    const double limit = -0.3 + 0.0117 * k, speed = 0.05 + 0.3 * std::pow(std::sin(7.0 * k), 2);
    const Solution s = motion_of(arm(fmt::format("limits = {{ from = {:.17g}, stiffness = 0.7 }}\nstart = {{ angle = "
                                                 "{:.17g} }}\n",
                                                 limit, limit + 0.01),
                                     dynamics(1, 0.5, 1e-9, fmt::format("\"h.angle\" = {:.17g}", -speed))));
    // Free, half a period of the stop's spring, and free again.
    ASSERT_EQ(s.event_rows.rows(), 2u);
    EXPECT_NEAR(s.event_rows.number(0, "time_s"), 0.01 / speed, 1e-9);
    EXPECT_NEAR(s.event_rows.number(1, "time_s"), 0.01 / speed + M_PI * std::sqrt(kAbout / 0.7), 1e-7);
  }
}

TEST(MotionDrive, WhatIsTooFastToFollowIsSaid) {
  const Prepared steep = test::prepared_motion(test::motion_scene(
      arm("start = { angle = 0.5 }\n",
          dynamics(1, 0.1, 1e-9) + "prescribe = { \"h.angle\" = { step = { to = 1.5, rise = 1e-12 } } }\n")));
  const Solution none = solve_motion(steep, {});
  EXPECT_EQ(none.summary.exit_code, kExitIncomplete);
  EXPECT_NE(none.summary.verdict.front().find("makes no headway"), std::string::npos) << none.summary.verdict.front();
}

/// At rest too: 0.5 N m/deg alone up to 50 deg, with 1 N m/deg more beyond.
TEST(MotionLimit, HoldsAtRest) {
  Prepared p = test::prepared_motion(test::motion_scene(R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.arm]
[joint.h]
type = "revolute"
parent = "ground"
child = "arm"
axis = [0, 0, 1]
stiffness = 0.5
limits = { to = 50, stiffness = 1 }
[load.moment]
on = "h.angle"
[[step]]
load = { moment = [0, 60] }
increments = 40
)"));
  p.steps = plan_steps(p.scene);
  ContactField field(p.model);
  const ResultTable t = test::judged(p, solve(p, field, {})).poses;
  ASSERT_EQ(t.rows(), 41u);
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const double moment = 1.5 * static_cast<double>(row), within = moment / 0.5;
    EXPECT_NEAR(t.number(row, "h.angle_deg"), within < 50 ? within : (moment + 50) / 1.5, 1e-10) << row;
  }
}

std::string dortmans_text() {
  std::string text = test::read_text(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml");
  const std::string body = "[body.femur]\n";
  text.insert(text.find(body) + body.size(), "mass = 4\ncentre_of_mass = [0, 0, 60]\ninertia = [0.05, 0.05, 0.01]\n");
  return text.substr(0, text.find("[[step]]"));
}

/// Equilibria at these angles of flexion (deg), one after the other.
ResultTable at_rest(const std::vector<double>& flexion) {
  std::string text = test::read_text(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml");
  text = text.substr(0, text.find("[[step]]"));
  for (std::size_t k = 1; k < flexion.size(); ++k)
    text +=
        fmt::format("[[step]]\nprescribe = {{ \"knee.flexion\" = [{:.17g}, {:.17g}] }}\n", flexion[k - 1], flexion[k]);
  Prepared p = test::prepared_motion(test::motion_scene(text));
  p.steps = plan_steps(p.scene);
  ContactField field(p.model);
  return test::judged(p, solve(p, field, {})).poses;
}

/// The flexion of the torus knee, the slower the nearer to equilibrium: what inertia costs falls with the square of the
/// time, 16 times where it takes 4 times as long.
TEST(MotionLimit, SlowMotionIsEquilibrium) {
  double last = 0;
  for (const double seconds : {2.0, 8.0, 32.0}) {
    const std::string drive = fmt::format(
        "start = \"equilibrium\"\nprescribe = {{ \"knee.flexion\" = {{ step = {{ from = 0, to = 50, rise = {} }} }} "
        "}}\n",
        seconds);
    const Solution s = motion_of(dortmans_text() + dynamics(seconds, seconds / 10, 1e-7) + drive);
    ASSERT_EQ(s.poses.rows(), 11u);
    std::vector<double> flexion;
    for (std::size_t row = 0; row < 11; ++row) flexion.push_back(s.poses.number(row, "knee.flexion_deg"));
    const ResultTable still = at_rest(flexion);
    ASSERT_EQ(still.rows(), 11u);
    double worst = 0;
    for (std::size_t row = 1; row < 10; ++row)
      worst = std::max(worst, std::abs(s.poses.number(row, "knee.flexion.reaction_Nm") -
                                       still.number(row, "knee.flexion.reaction_Nm")));
    if (last > 0) {
      EXPECT_GT(last / worst, 10) << seconds;
      EXPECT_LT(last / worst, 25) << seconds;
    }
    last = worst;
  }
  EXPECT_LT(last, 1e-3) << "N m";
}

}  // namespace
}  // namespace genu
