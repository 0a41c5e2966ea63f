// Loads with feedback against closed forms: a hinge held by a controller is a damped oscillator, driven where its
// target moves; at rest it stands where springs do; a coupling makes one joint follow another.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"
#include "validation/motion_scene.h"

namespace genu {
namespace {

using test::motion_of;

constexpr double kServoInertia = 0.05;  // kg m^2, about the hinge

std::string servo_hinge(const std::string& load, double duration) {
  return fmt::format(R"(format = 1
units = {{ length = "m", angle = "rad" }}
[body.ground]
fixed = true
[body.arm]
mass = 1
inertia = [{0}, {0}, {0}]
[joint.j]
type = "revolute"
parent = "ground"
child = "arm"
axis = [0, 0, 1]
start = {{ angle = 0.4 }}
{1}
[dynamics]
duration = {2}
output_interval = 0.01
tolerance = 1e-9
)",
                     kServoInertia, load, duration);
}

std::string servo(const std::string& target, double gain, double rate_gain) {
  return fmt::format(
      "[load.servo]\non = \"j.angle\"\nscale = {{ feedback = {{ of = \"j.angle\", target = {}, gain = {}, "
      "rate_gain = {} }} }}\n",
      target, gain, rate_gain);
}

TEST(Feedback, AHingeHeldByAControllerIsADampedOscillator) {
  const double gain = 20, rate_gain = 0.3, target = 0.1;
  const Solution s = motion_of(servo_hinge(servo(fmt::format("{}", target), gain, rate_gain), 3));
  const double decay = rate_gain / (2 * kServoInertia), w = std::sqrt(gain / kServoInertia - decay * decay);
  double worst = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double t = s.poses.number(row, "time_s");
    const double q = target + (0.4 - target) * std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
    worst = std::max(worst, std::abs(s.poses.number(row, "j.angle_deg") * M_PI / 180 - q));
    const double rate = s.poses.number(row, "j.angle_velocity_deg_s") * M_PI / 180;
    EXPECT_NEAR(s.poses.number(row, "servo.scale"), gain * (target - q) - rate_gain * rate, 1e-6);
  }
  EXPECT_LT(worst, 1e-8) << "rad";
  EXPECT_LT(s.summary.motion->worst_energy, 1e-7 * s.summary.motion->energy_scale);
  fmt::print("  worst error of the angle {:.1e} rad\n", worst);
}

/// After the transient: the response of a driven oscillator to its target's sine.
TEST(Feedback, FollowsAMovingTargetAsADrivenOscillatorDoes) {
  const double gain = 20, rate_gain = 0.6, A = 0.2, f = 1.5, W = 2 * M_PI * f;
  const Solution s = motion_of(
      servo_hinge(servo(fmt::format("{{ sine = {{ amplitude = {}, frequency = {} }} }}", A, f), gain, rate_gain), 6));
  // I q'' + D q' + k q = k r + D r':  H = (k + i W D) / (k - I W^2 + i W D)
  const double re = gain - kServoInertia * W * W, im = W * rate_gain, size = re * re + im * im;
  const double a = (gain * re + im * im) / size, b = (im * re - gain * im) / size;
  double worst = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double t = s.poses.number(row, "time_s");
    if (t < 4.5) continue;  // the transient decays by exp(-6 t)
    const double q = A * (a * std::sin(W * t) + b * std::cos(W * t));
    worst = std::max(worst, std::abs(s.poses.number(row, "j.angle_deg") * M_PI / 180 - q));
  }
  EXPECT_LT(worst, 1e-7) << "rad";
  fmt::print("  worst error of the driven angle {:.1e} rad\n", worst);
}

/// The same motion with the bodies' poses as unknowns in the place of angles (a contact that never closes).
TEST(Feedback, IsTheSameWithConstraintsInThePlaceOfAngles) {
  const std::string contact =
      "[surface.pin]\nbody = \"arm\"\nshape = \"sphere\"\nradius = 0.001\n[surface.wall]\nbody = \"ground\"\nshape = "
      "\"plane\"\norigin = [0, 0, -1]\n[contact.never]\nsurfaces = [\"pin\", \"wall\"]\nmodel = \"rigid\"\n";
  const std::string load = servo("{ sine = { amplitude = 0.2, frequency = 1.5 } }", 20, 0.6);
  const Solution angles = motion_of(servo_hinge(load, 2)), bodies = motion_of(servo_hinge(load + contact, 2));
  ASSERT_EQ(angles.poses.rows(), bodies.poses.rows());
  for (std::size_t row = 0; row < angles.poses.rows(); ++row)
    for (const char* column : {"j.angle_deg", "servo.scale", "energy.load_work_J"})
      EXPECT_NEAR(angles.poses.number(row, column), bodies.poses.number(row, column), 1e-6) << column << " " << row;
}

const std::string kServoHinges = R"(format = 1
units = { length = "m", angle = "rad" }
[body.ground]
fixed = true
[body.first]
[body.second]
[joint.a]
type = "revolute"
parent = "ground"
child = "first"
axis = [0, 0, 1]
[joint.b]
type = "revolute"
parent = "ground"
child = "second"
origin = [1, 0, 0]
axis = [0, 0, 1]
stiffness = 3
[load.push]
on = "a.angle"
value = 2
[load.servo]
on = "a.angle"
scale = { feedback = { of = "a.angle", target = 0.5, gain = 10 } }
[load.coupling]
on = "b.angle"
scale = { feedback = { of = "a.angle", target = 0, gain = COUPLING } }
[[step]]
load = { push = [0, 1] }
increments = 4
)";

/// 10 (0.5 - a) + 2 = 0 and 3 b = -g a.
TEST(Feedback, AtRestItIsASpringAndACouplingIsFollowed) {
  const ResultTable t = test::table_of(test::with_first(kServoHinges, "COUPLING", "1.5"));
  const std::size_t last = t.rows() - 1;
  EXPECT_NEAR(t.number(last, "a.angle_deg") * M_PI / 180, 0.7, 1e-12);
  EXPECT_NEAR(t.number(last, "b.angle_deg") * M_PI / 180, -0.35, 1e-12);
  EXPECT_EQ(test::word(t, last, "stability"), "stable");
  EXPECT_NEAR(t.number(last, "coupling.scale"), -1.05, 1e-12);
}

/// Each of two joints driven by the other: beyond a loop gain of 1 nothing holds them, and that is said.
TEST(Feedback, ALoopThatDrivesItselfIsUnstable) {
  const std::string loop =
      "[load.back]\non = \"a.angle\"\nscale = { feedback = { of = \"b.angle\", target = 0, gain = 30 } }\n[[step]]";
  for (const double gain : {0.5, 1.5}) {  // loop gain: gain / 3 x 30 / 10
    const std::string text =
        test::with_first(test::with_first(kServoHinges, "COUPLING", fmt::format("{}", gain)), "[[step]]", loop);
    const ResultTable t = test::table_of(text);
    EXPECT_EQ(test::word(t, t.rows() - 1, "stability"), gain < 1 ? "stable" : "unstable") << gain;
  }
}

/// A load that follows the angle of a hinge with a sign that drives it on: the motion grows, and that is said.
TEST(Feedback, AMotionThatGrowsIsSaid) {
  const auto verdict_of = [](double push) {
    // gain (0 - q) times value = -push: a spring that pulls (push < 0 pushes away).
    const std::string load = fmt::format(
        "[load.servo]\non = \"j.angle\"\nvalue = {}\nscale = {{ feedback = {{ of = \"j.angle\", target = 0.39, gain = "
        "1, "
        "rate_gain = 0.01 }} }}\n",
        push);
    std::string text;
    for (const std::string& sentence : motion_of(servo_hinge(load, 2)).summary.verdict) text += sentence + "\n";
    return text;
  };
  EXPECT_NE(verdict_of(-0.5).find("load servo misses its target by more and more"), std::string::npos);
  EXPECT_EQ(verdict_of(0.5).find("more and more"), std::string::npos);
}

/// Nothing acts until the target moves; then the wrong sign throws the hinge about within a few rows, and the
/// integration stops early.
TEST(Feedback, AWrongSignThatActsLateIsSaid) {
  std::string text = test::read_file(test::source_folder() + "/meshes/leskovar2019/scene-controlled.toml");
  const std::string on = "on = \"j1.angle\"";
  const std::size_t at = text.find(on);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, on.size(), "body = \"tibia\"\nmoment = [0, 0, 1]");  // flexion is about -z
  text.replace(text.find("duration = 17"), 13, "duration = 1.1");
  std::string said;
  for (const std::string& sentence : motion_of(text).summary.verdict) said += sentence + "\n";
  EXPECT_NE(said.find("load controller misses its target by more and more"), std::string::npos) << said;
}

/// A weak controller lags behind a target that moves faster and faster: it does what it can.
TEST(Feedback, ATargetThatMovesOnIsNoGrowth) {
  const Solution s = motion_of(servo_hinge(servo("{ step = { from = 0.4, to = 1.6, rise = 6 } }", 0.02, 0.01), 3));
  for (const std::string& sentence : s.summary.verdict)
    EXPECT_EQ(sentence.find("more and more"), std::string::npos) << sentence;
}

/// A gain beyond reason makes a fast decay: integrated by BDF, and said.
TEST(Feedback, AStiffMotionIsSaid) {
  const Solution s = motion_of(servo_hinge(servo("0.1", 1e4, 5e3), 2));
  EXPECT_LT(s.summary.motion->steps, 20'000);
  std::string text;
  for (const std::string& sentence : s.summary.verdict) text += sentence + "\n";
  EXPECT_NE(text.find("is stiff from"), std::string::npos) << text;
  EXPECT_NEAR(s.poses.number(s.poses.rows() - 1, "j.angle_deg") * M_PI / 180, 0.1 + 0.3 * std::exp(-2.0 * 2), 0.01);
}

/// meshes/leskovar2019/scene-controlled.toml: slow against the joints, so the springs of both decide how far it gets.
TEST(Feedback, TheControlledKneeReachesWhatItsGainAllows) {
  const Solution s = motion_of(test::read_file(test::source_folder() + "/meshes/leskovar2019/scene-controlled.toml"));
  double most = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) most = std::max(most, s.poses.number(row, "j1.angle_deg"));
  EXPECT_NEAR(most, 26.9, 0.05);
  EXPECT_NEAR(most, 30 * 5 / (5 + 0.5535), 0.2) << "but for the patella's spring";
}

}  // namespace
}  // namespace genu
