// Paths by arc length: past limit points, through changes of contact, round a loop, each against a closed form.
#include "genu/path/arc_length_follower.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/knee_scene.h"
#include "support/solved.h"

namespace genu {
namespace {

using test::follow;
using test::Followed;
using test::kNoTurn;
using Kind = PathEvent::Kind;

constexpr double kHalfSpan = 0.04, kRise = 0.012;  // m
const double kRest = std::hypot(kHalfSpan, kRise);

/// Load (N, downward) that holds the node of a von Mises truss of two springs of 50 N/mm at height z.
double truss_load(double z) {
  const double length = std::hypot(kHalfSpan, z);
  return 2 * 50e3 * z * (kRest / length - 1);
}

std::string truss_by_arc_length(const std::string& step) {
  return test::truss(
      test::step("prescribe = { \"j.x\" = 0, \"j.y\" = 0, " + kNoTurn + " }\ncontrol = \"arc_length\"\n" + step));
}

TEST(ArcLengthFollower, FollowsTheTrussPastBothLimitLoads) {
  const Followed w = follow(truss_by_arc_length("load = { w = [0, 25] }\nincrements = 25"));
  ASSERT_TRUE(w.result.complete) << w.story();
  const double critical = std::cbrt(kRest * kHalfSpan * kHalfSpan);
  const double z = std::sqrt(critical * critical - kHalfSpan * kHalfSpan), load = truss_load(z);
  const auto limits = w.of(Kind::limit_point);
  ASSERT_EQ(limits.size(), 2u) << w.story();
  for (const double side : {1.0, -1.0}) {
    const PathEvent& limit = limits[side > 0 ? 0 : 1];
    EXPECT_NEAR(limit.target.load_factors[0], side * load, 1e-10 * load);
    EXPECT_NEAR(limit.coordinates[0][5], side * z, 1e-9);
  }
  double worst = 0;
  int unstable = 0;
  for (const PosePoint& p : w.points) {
    const double height = p.pose.state.poses[1].p.z();
    ASSERT_TRUE(p.solved());
    EXPECT_NEAR(p.t * 25, p.increment, 1e-12);
    worst = std::max(worst, std::abs(truss_load(height) - p.target.load_factors[0]));
    EXPECT_EQ(p.stability.verdict == Stability::Verdict::stable, std::abs(height) > z) << height;
    unstable += std::abs(height) < z ? 1 : 0;
  }
  EXPECT_LT(worst, 1e-9) << "N";
  EXPECT_EQ(unstable, 39) << "from 19 N down to -19 N";
  EXPECT_EQ(w.points.size(), 20u + 39u + 45u);
}

TEST(ArcLengthFollower, GivesWhatControlByValuesGivesWhereNothingTurnsBack) {
  const auto at = [](const std::string& control) {
    return follow(test::knee("[[step]]\nprescribe = { \"knee.flexion\" = [0, 60] }\nincrements = 12\n" + control));
  };
  const Followed values = at(""), arc = at("control = \"arc_length\"\n");
  ASSERT_TRUE(arc.result.complete) << arc.story();
  ASSERT_EQ(arc.points.size(), values.points.size());
  for (std::size_t i = 0; i < arc.points.size(); ++i) {
    const State &a = arc.points[i].pose.state, &b = values.points[i].pose.state;
    EXPECT_LT((a.poses[1].p - b.poses[1].p).norm(), 1e-11) << i;
    EXPECT_NEAR(a.contacts[0].force, b.contacts[0].force, 1e-7) << i;
    EXPECT_NEAR(arc.points[i].stability.smallest, values.points[i].stability.smallest, 1e-9) << i;
  }
}

TEST(ArcLengthFollower, PassesALiftOffAndTouchesDownAgain) {
  const std::string held = "prescribe = { " + kNoTurn + " }\ncontrol = \"arc_length\"\nincrements = 10\n";
  const Followed w = follow(test::held_ball(test::step(held + "load = { lift = [0, 100] }") +
                                            test::step(held + "load = { lift = [100, 0] }")));
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.of(Kind::contact_lost).size(), 1u) << w.story();
  ASSERT_EQ(w.of(Kind::contact_gained).size(), 1u) << w.story();
  EXPECT_NEAR(w.of(Kind::contact_lost)[0].target.load_factors[0], test::kLiftOff, 1e-6);
  EXPECT_NEAR(w.of(Kind::contact_gained)[0].target.load_factors[0], test::kLiftOff, 1e-6);
  for (const PosePoint& p : w.points)
    EXPECT_EQ(p.pose.state.contacts.size(), p.target.load_factors[0] < test::kLiftOff ? 1u : 0u);
}

TEST(ArcLengthFollower, TurnsBackAtAContactToo) {
  // The node of the truss is a ball now and meets a slope on the falling branch: from there on the slope carries more
  // and more, and the load grows again. The springs are stiff sideways, so that the ball hardly slides.
  constexpr double kSlope = 0.1, kRadius = 0.005, kDrop = 0.003;  // rad, m, m
  const Followed w =
      follow(test::bone_on_ground("{ z = 12 }") +
             test::ligament("l", "[0, 0, 0]", "[-40, 0, 0]", "law = \"spring\"\nstiffness = 50\nreference_force = 0") +
             test::ligament("r", "[0, 0, 0]", "[40, 0, 0]", "law = \"spring\"\nstiffness = 50\nreference_force = 0") +
             test::load("w", "force = [0, 0, -1]") + test::surface("ball", "bone", "sphere", "radius = 5") +
             test::surface("slope", "ground", "plane",
                           "origin = [0, 0, -3]\nz_axis = [0.09983341664682815, 0, 0.99500416527802582]\n"
                           "x_axis = [0.99500416527802582, 0, -0.09983341664682815]") +
             test::contact("c", "ball", "slope") +
             test::step("prescribe = { \"j.y\" = 0, " + kNoTurn +
                        " }\ncontrol = \"arc_length\"\nload = { w = [0, 25] }\nincrements = 25"));
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.of(Kind::contact_gained).size(), 1u) << w.story();
  const auto limits = w.of(Kind::limit_point);
  ASSERT_EQ(limits.size(), 2u) << w.story();
  const double touch = kRadius / std::cos(kSlope) - kDrop;
  EXPECT_NEAR(limits[1].coordinates[0][5], touch, 1e-9);
  EXPECT_NEAR(limits[1].target.load_factors[0], truss_load(touch), 1e-5);
  double worst = 0;
  for (const PosePoint& p : w.points) {
    // Springs, load and the slope's push along its normal, summed by hand.
    const Vec3 at = p.pose.state.poses[1].p;
    Vec3 force(0, 0, -p.target.load_factors[0]);
    for (const double end : {-kHalfSpan, kHalfSpan}) {
      const Vec3 arm = Vec3(end, 0, 0) - at;
      force += 50e3 * (arm.norm() - kRest) * arm.normalized();
    }
    for (const ActiveContact& c : p.pose.state.contacts) force += c.force * Vec3(std::sin(kSlope), 0, std::cos(kSlope));
    worst = std::max({worst, std::abs(force.x()), std::abs(force.z())});
  }
  EXPECT_LT(worst, 1e-8) << "N";
  EXPECT_EQ(w.points.back().pose.state.contacts.size(), 1u);
}

TEST(ArcLengthFollower, ThreeWaysMeetAtTheLimitOfTheTorusKneesMoment) {
  // The flexion moment is largest where its reaction turns (flexion prescribed), where a prescribed moment ends, and
  // where arc length turns back.
  const Followed flexion = follow(test::knee("[[step]]\nprescribe = { \"knee.flexion\" = [0, 90] }\nincrements = 9\n"));
  const std::string moment = "[load.m]\non = \"knee.flexion\"\n[[step]]\nload = { m = [-0.9, 0.7] }\nincrements = 4\n";
  const Followed ended = follow(test::knee(moment)), arc = follow(test::knee(moment + "control = \"arc_length\"\n"));
  const auto a = flexion.of(Kind::reaction_turns), b = ended.of(Kind::turns_back), c = arc.of(Kind::limit_point);
  ASSERT_TRUE(flexion.result.complete) << flexion.story();
  ASSERT_EQ(a.size(), 1u) << flexion.story();
  ASSERT_EQ(b.size(), 1u) << ended.story();
  ASSERT_FALSE(c.empty()) << arc.story();
  const double degree = M_PI / 180;
  EXPECT_NEAR(a[0].coordinates[0][0] / degree, 81, 0.5);
  EXPECT_NEAR(b[0].coordinates[0][0] / degree, a[0].coordinates[0][0] / degree, 1e-6);
  EXPECT_NEAR(c[0].coordinates[0][0] / degree, a[0].coordinates[0][0] / degree, 1e-6);
  EXPECT_NEAR(b[0].target.load_factors[0], c[0].target.load_factors[0], 1e-10);
}

TEST(ArcLengthFollower, AClosedPathIsNoticed) {
  // A crank: its end hangs on a spring from a point outside its circle, and a moment on it has no more to give than
  // the spring. Followed round, the crank is back where it began.
  const Followed w = follow(R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.crank]
[joint.hinge]
type = "revolute"
parent = "ground"
child = "crank"
axis = [0, 0, 1]
[ligament.s]
from = { body = "ground", point = [50, 0, 0] }
to = { body = "crank", point = [20, 0, 0] }
law = "spring"
stiffness = 10
slack_length = 10
[load.m]
on = "hinge.angle"
[[step]]
load = { m = [0, 100] }
control = "arc_length"
increments = 100
)");
  EXPECT_FALSE(w.result.complete);
  EXPECT_EQ(w.of(Kind::closed).size(), 1u) << w.story();
  EXPECT_EQ(w.of(Kind::limit_point).size(), 2u) << w.story();
}

}  // namespace
}  // namespace genu
