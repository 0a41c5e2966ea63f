// Paths with known events: lift-off, touch-down, a change of foot, a limit point, and the way back.
#include "genu/path/path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::follow;
using test::Followed;
using test::kNoTurn;
using Kind = PathEvent::Kind;

PathOptions fine() {
  PathOptions options;
  options.event_tolerance = 1e-11;
  return options;
}

TEST(Path, LiftsOffAtTheExactLoadAndTouchesDownAgain) {
  const Followed w = follow(
      test::held_ball(test::step("prescribe = { " + kNoTurn + " }\nload = { lift = [0, 100] }\nincrements = 10") +
                      test::step("prescribe = { " + kNoTurn + " }\nload = { lift = [100, 0] }\nincrements = 10")),
      fine());
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.points.size(), 21u);
  const auto lost = w.of(Kind::contact_lost), gained = w.of(Kind::contact_gained);
  ASSERT_EQ(lost.size(), 1u) << w.story();
  ASSERT_EQ(gained.size(), 1u) << w.story();
  EXPECT_NEAR(lost[0].target.load_factors[0], test::kLiftOff, 1e-9 * test::kLiftOff);
  EXPECT_NEAR(gained[0].target.load_factors[0], test::kLiftOff, 1e-9 * test::kLiftOff);
  EXPECT_EQ(lost[0].what, "foot.1");
  EXPECT_EQ(gained[0].what, "foot.1") << "a contact that comes back keeps its number";
  for (const PosePoint& p : w.points) {
    const double load = p.target.load_factors[0];
    const double length = load > test::kLiftOff ? 0.018 * (1 + std::sqrt(load / 5000)) : 0.02;
    EXPECT_NEAR(p.pose.state.poses[1].p.z(), length, 1e-12) << load;
    const auto& contacts = p.pose.state.contacts;
    ASSERT_EQ(contacts.size(), load < test::kLiftOff ? 1u : 0u) << load;
    for (const ActiveContact& c : contacts) EXPECT_NEAR(c.force, test::kLiftOff - load, 1e-9);
  }
}

/// Two balls under one bone, pressed onto a floor and tilted from one to the other.
std::string two_feet(const std::string& steps) {
  return test::bone_on_ground("{ z = 20 }") +
         test::surface("left", "bone", "sphere", "origin = [-30, 0, 0]\nradius = 20") +
         test::surface("right", "bone", "sphere", "origin = [30, 0, 0]\nradius = 20") +
         test::surface("floor", "ground", "plane") + test::contact("l", "left", "floor") +
         test::contact("r", "right", "floor") + test::spring("s", "[-20, 0, 0]", "[-20, 0, 0]", 2, 10) +
         test::spring("t", "[20, 0, 0]", "[20, 0, 0]", 2, 10) + steps;
}

TEST(Path, ChangesFeetWhereBothStand) {
  // With the tilt prescribed one foot carries all, the other none: they swap at b = 0, where both touch and any split
  // balances. (A turn b > 0 about y lowers the right foot.)
  const Followed w =
      follow(two_feet(test::step("prescribe = { \"j.a\" = 0, \"j.c\" = 0, \"j.b\" = [-0.03, 0.05] }\nincrements = 7")),
             fine());
  ASSERT_TRUE(w.result.complete) << w.story();
  for (const PosePoint& p : w.points) {
    const double b = p.target.prescribed[2].value;
    ASSERT_EQ(p.pose.state.contacts.size(), 1u) << b << "\n" << w.story();
    EXPECT_EQ(p.pose.state.contacts[0].pair, b < 0 ? 0 : 1) << b;
    EXPECT_NEAR(p.pose.state.poses[1].p.z(), 0.02 + 0.03 * std::sin(std::abs(b)), 1e-10) << b;
    EXPECT_GE(p.report.certificate.smallest_gap, -1e-9);
  }
  const auto gained = w.of(Kind::contact_gained);
  ASSERT_EQ(gained.size(), 1u) << w.story();
  EXPECT_EQ(gained[0].what, "r.1");
  EXPECT_NEAR(gained[0].target.prescribed[2].value, 0, 1e-9);
}

TEST(Path, GainsASecondContactOnTheWay) {
  // Tilt free, and a load that wanders from over the left foot to between both: the right foot comes down and stays.
  std::string text = two_feet("");
  text += test::load("tip", "force = [0, 0, -100]\npoint = [-60, 0, 0]") +
          test::load("press", "force = [0, 0, -100]\npoint = [25, 0, 0]");
  const Followed w =
      follow(text + test::step("prescribe = { \"j.a\" = 0, \"j.c\" = 0, \"j.y\" = 0 }\nload = { tip = [1, 0], "
                               "press = [0, 1] }\nincrements = 10"),
             fine());
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.of(Kind::contact_gained).size(), 1u) << w.story();
  EXPECT_EQ(w.points.front().pose.state.contacts.size(), 1u);
  EXPECT_EQ(w.points.back().pose.state.contacts.size(), 2u);
  for (const PosePoint& p : w.points) {
    EXPECT_GE(p.report.certificate.smallest_force, 0) << p.t;
    EXPECT_GE(p.report.certificate.smallest_gap, -1e-9) << p.t;
    EXPECT_LT(p.report.certificate.least_opposed, -1 + 1e-12) << p.t;
  }
}

TEST(Path, ContactsMayLeaveNoFreedom) {
  // A ball of 10 mm in the trough z = x^2 / (16 2/3 mm) stands on both flanks, at x^2 = 100 - (8 1/3)^2: four
  // prescribed coordinates and two contacts hold it in place, and statics has one answer. A side load shifts force from
  // one flank to the other, until one of them opens and the ball rolls up the other.
  constexpr double kDepth = 25.0 / 3;  // mm: a parabola's subnormal is constant
  const Followed w = follow(
      test::bone_on_ground("{ z = 10.2 }") + test::surface("ball", "bone", "sphere", "radius = 10") +
      test::surface("trough", "ground", "polynomial", "terms = [[2, 0, 0.06]]") + test::contact("c", "ball", "trough") +
      test::load("w", "force = [0, 0, -10]") + test::load("side", "force = [1, 0, 0]") +
      test::step("prescribe = { \"j.y\" = 0, " + kNoTurn + " }\nload = { side = [0, 8] }\nincrements = 8"));
  ASSERT_TRUE(w.result.complete) << w.story();
  const double cosine = kDepth / 10, sine = std::sqrt(1 - cosine * cosine);
  ASSERT_EQ(w.points.size(), 9u);
  for (const PosePoint& p : w.points) {
    const double side = p.target.load_factors[1];
    if (side > 10 * sine / cosine) {
      EXPECT_EQ(p.pose.state.contacts.size(), 1u) << side;
      EXPECT_GT(p.pose.state.poses[1].p.x(), 0) << side;
      continue;
    }
    ASSERT_EQ(p.pose.state.contacts.size(), 2u) << side;
    EXPECT_NEAR(p.pose.state.poses[1].p.x(), 0, 1e-14) << side;
    EXPECT_NEAR(1e3 * p.pose.state.poses[1].p.z(), kDepth + 0.06 * 100 * sine * sine, 1e-10) << side;
    EXPECT_EQ(p.stability.free_motions, 0) << side;
    EXPECT_EQ(p.stability.verdict, Stability::Verdict::stable) << side;
    std::vector<double> forces{p.pose.state.contacts[0].force, p.pose.state.contacts[1].force};
    std::sort(forces.begin(), forces.end());
    EXPECT_NEAR(forces[0], 5 / cosine - side / (2 * sine), 1e-10) << side;
    EXPECT_NEAR(forces[1], 5 / cosine + side / (2 * sine), 1e-10) << side;
  }
  EXPECT_EQ(w.of(Kind::contact_lost).size(), 1u) << w.story();
}

constexpr double kSnapLoad =
    19.899833915489113;  // N: limit of a truss of 40 mm half span, 12 mm rise, two springs of 50 N/mm

TEST(Path, TrussTurnsBackAtItsLimitLoad) {
  const Followed w = follow(test::truss(test::step("prescribe = { \"j.x\" = 0, \"j.y\" = 0, " + kNoTurn +
                                                   " }\nload = { w = [0, 25] }\nincrements = 25")));
  EXPECT_FALSE(w.result.complete);
  const auto back = w.of(Kind::turns_back);
  ASSERT_EQ(back.size(), 1u) << w.story();
  EXPECT_NEAR(back[0].target.load_factors[0], kSnapLoad, 1e-4);
  EXPECT_LE(back[0].target.load_factors[0], kSnapLoad * (1 + 1e-9));
  EXPECT_EQ(w.of(Kind::stopped).size(), 1u);
  // All poses below the limit were handed over; each balances the load on the upper, stable branch.
  std::size_t solved = 0;
  for (const PosePoint& p : w.points) {
    if (!p.solved()) continue;
    ++solved;
    const double z = p.pose.state.poses[1].p.z(), length = std::hypot(0.04, z), rest = std::hypot(0.04, 0.012);
    EXPECT_NEAR(2 * 50e3 * (rest - length) * z / length, p.target.load_factors[0], 1e-9);
    EXPECT_EQ(p.stability.verdict, Stability::Verdict::stable);
  }
  EXPECT_EQ(solved, 20u);
}

TEST(Path, TrussSnapsThroughUnderPrescribedHeight) {
  // The height prescribed instead, the whole path is there; the multiplier is the load.
  const Followed w = follow(test::truss(test::step("prescribe = { \"j.y\" = 0, \"j.z\" = [12, -12], " + kNoTurn +
                                                   " }\nload = { w = 0 }\nincrements = 24")));
  ASSERT_TRUE(w.result.complete) << w.story();
  double largest = 0;
  for (const PosePoint& p : w.points) {
    const double z = p.pose.state.poses[1].p.z(), length = std::hypot(0.04, z), rest = std::hypot(0.04, 0.012);
    EXPECT_NEAR(p.pose.state.multipliers[1], -2 * 50e3 * (rest - length) * z / length, 1e-8) << z;
    largest = std::max(largest, -p.pose.state.multipliers[1]);
  }
  EXPECT_NEAR(largest, kSnapLoad, 0.02 * kSnapLoad);
}

TEST(Path, StartsWhereTheSceneSaysWithTheSameLigaments) {
  // The truss begins below its supports: the slack lengths are those of the reference, the pose is the inverted one.
  std::string text =
      test::truss(test::step("prescribe = { \"j.x\" = 0, \"j.y\" = 0, " + kNoTurn + " }\nload = { w = [0, 10] }"));
  text.replace(text.find("reference = { z = 12 }"), 22, "reference = { z = 12 }\nstart = { z = -11 }");
  const Followed w = follow(text);
  ASSERT_TRUE(w.result.complete) << w.story();
  EXPECT_NEAR(w.points[0].pose.state.poses[1].p.z(), -0.012, 1e-12);
  EXPECT_LT(w.points[1].pose.state.poses[1].p.z(), -0.012);
}

TEST(Path, ForwardAndBackwardAgree) {
  const Followed w =
      follow(test::knee("[[step]]\nprescribe = { \"knee.flexion\" = [0, 60] }\nincrements = 12\n"
                        "[[step]]\nprescribe = { \"knee.flexion\" = [60, 0] }\nincrements = 12\n"));
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.points.size(), 25u);
  for (std::size_t i = 0; i < 12; ++i) {
    const State &there = w.points[i].pose.state, &back = w.points[24 - i].pose.state;
    EXPECT_LT((there.poses[1].p - back.poses[1].p).norm(), 1e-11) << i;
    EXPECT_LT((there.poses[1].R - back.poses[1].R).norm(), 1e-9) << i;
    ASSERT_EQ(there.contacts.size(), back.contacts.size());
    EXPECT_NEAR(there.multipliers[0], back.multipliers[0], 1e-8);
  }
}

TEST(Path, DoesNotDependOnItsIncrements) {
  const auto at_end = [](int increments) {
    return follow(test::knee("[[step]]\nprescribe = { \"knee.flexion\" = [0, 60] }\nincrements = " +
                             std::to_string(increments) + "\n"))
        .points.back()
        .pose.state;
  };
  const State few = at_end(1), many = at_end(60);
  EXPECT_LT((few.poses[1].p - many.poses[1].p).norm(), 1e-11);
  EXPECT_NEAR(few.contacts[0].force, many.contacts[0].force, 1e-6);
}

TEST(Path, ColdStartsFromOverlapAndFromFarMeet) {
  const auto from = [](double z) {
    return follow(
        test::held_ball(test::step("prescribe = { " + kNoTurn + " }\nload = { lift = [0, 10] }\nincrements = 1"), z));
  };
  for (const double z : {15.0, 19.0, 20.5, 30.0}) {
    const Followed w = from(z);
    ASSERT_TRUE(w.result.complete) << z << "\n" << w.story();
    EXPECT_LT((w.points[0].pose.state.poses[1].p - Vec3(0, 0, 0.02)).norm(), 1e-9) << z;
    ASSERT_EQ(w.points[0].pose.state.contacts.size(), 1u);
    EXPECT_NEAR(w.points[0].pose.state.contacts[0].force, test::kLiftOff, 1e-7) << z;
  }
}

TEST(Path, ASnapIsNoWindowToStepOver) {
  // A leg of two hinges pushes its foot round a ball under a growing moment, until the foot slips off: contact or not,
  // no equilibrium lies beyond, and the next one is far away.
  const Followed w = follow(R"(format = 1
units = { length = "m", angle = "rad" }
gravity = [0, -9.81, 0]
[body.world]
fixed = true
[body.upper]
mass = 3
centre_of_mass = [0, -0.2, 0]
[body.lower]
mass = 2
centre_of_mass = [0, -0.15, 0]
[joint.hip]
type = "revolute"
parent = "world"
child = "upper"
axis = [0, 0, 1]
stiffness = 2
[joint.knee]
type = "revolute"
parent = "upper"
child = "lower"
origin = [0, -0.4, 0]
axis = [0, 0, 1]
stiffness = 1
[surface.toe]
body = "lower"
shape = "sphere"
radius = 0.05
origin = [0, -0.35, 0]
[surface.ball]
body = "world"
shape = "sphere"
radius = 0.2
origin = [0.25, -0.85, 0]
[contact.kick]
surfaces = ["toe", "ball"]
model = "rigid"
[load.swing]
on = "hip.angle"
value = 18
[[step]]
load = { swing = [0, 1] }
increments = 10
)");
  EXPECT_FALSE(w.result.complete);
  EXPECT_TRUE(w.of(PathEvent::Kind::stepped_over).empty()) << w.story();
  EXPECT_EQ(w.of(PathEvent::Kind::turns_back).size(), 1u) << w.story();
  EXPECT_EQ(w.of(PathEvent::Kind::snaps).size(), 1u) << w.story();
}

TEST(Path, SnapsBetweenRigidSurfacesWhereAStablePoseLiesBeyond) {
  // A ball of 5 mm rests on z = a x^4 / 4 - b x^2 / 2 + c x y where the slope along x is 0: a x^3 - b x + c y = 0 at
  // the contact point. Along y the valley at x > 0 ends at x = sqrt(b / (3 a)), and the ball falls to the other one.
  constexpr double a = 4e-4, b = 0.04, c = 0.02, r = 5;  // mm
  const auto [ground, drive] = std::pair(
      test::surface("ball", "bone", "sphere", "radius = 5") +
          test::surface("valleys", "ground", "polynomial", "terms = [[4, 0, 1e-4], [2, 0, -0.02], [1, 1, 0.02]]") +
          test::contact("c", "ball", "valleys") + test::load("w", "force = [0, 0, -10]"),
      test::step("prescribe = { \"j.y\" = [0, 12], " + kNoTurn + " }\nincrements = 12"));
  const Followed w = follow(test::bone_on_ground("{ x = 10, z = 4 }") + ground + drive, fine());
  ASSERT_TRUE(w.result.complete) << w.story();
  const auto ball_y = [&](double x) {  // mm: its centre lies on the normal
    const double slope = c * x;
    return (b * x - a * x * x * x) / c - r * slope / std::hypot(1, slope);
  };
  const auto snapped = w.of(Kind::snapped), landed = w.of(Kind::new_branch);
  ASSERT_EQ(snapped.size(), 1u) << w.story();
  ASSERT_EQ(landed.size(), 1u) << w.story();
  double fold = 0;  // mm: the largest y of the first valley
  for (double x = 4; x < 10; x += 1e-4) fold = std::max(fold, ball_y(x));
  EXPECT_NEAR(1e3 * snapped[0].target.prescribed[0].value, fold, 1e-5);
  EXPECT_GT(snapped[0].coordinates[0][3], 0);
  EXPECT_LT(landed[0].coordinates[0][3], 0);
  EXPECT_EQ(landed[0].what, "stable");
  for (const PosePoint& p : w.points) {
    const double x = 1e3 * p.pose.state.poses[1].p.x(), y = 1e3 * p.target.prescribed[0].value;
    EXPECT_EQ(x > 0, y < fold) << y;
    EXPECT_NEAR(ball_y(x), y, 1e-9) << y;
    EXPECT_EQ(p.stability.verdict, Stability::Verdict::stable) << y;
  }
}

TEST(Path, EndsAtAFoldBeyondWhichNothingIsAtRest) {
  // The same with one valley: a x^3 falls away beyond it.
  const Followed w =
      follow(test::bone_on_ground("{ x = -4, z = 4.9 }") + test::surface("ball", "bone", "sphere", "radius = 5") +
             test::surface("slope", "ground", "polynomial", "terms = [[3, 0, -1e-3], [1, 0, 0.05], [1, 1, -0.01]]") +
             test::contact("c", "ball", "slope") + test::load("w", "force = [0, 0, -10]") +
             test::step("prescribe = { \"j.y\" = [0, 12], " + kNoTurn + " }\nincrements = 12"));
  EXPECT_FALSE(w.result.complete);
  EXPECT_TRUE(w.of(Kind::snapped).empty()) << w.story();
}

TEST(Path, StopsWhenCancelled) {
  const auto s =
      test::scene_model(test::knee("[[step]]\nprescribe = { \"knee.flexion\" = [0, 60] }\nincrements = 60\n"));
  ContactField field(s.model);
  int poses = 0;
  PathObserver observer;
  observer.pose = [&](const PosePoint&, LayerMemories*) { ++poses; };
  observer.cancelled = [&] { return poses >= 5; };
  const PathResult result = follow_path(s.model, field, plan_steps(s.scene), {}, observer);
  EXPECT_FALSE(result.complete);
  EXPECT_EQ(poses, 5);
}

/// A ball on a smooth layer, rolled and pressed.
std::string soft_ball(const std::string& control) {
  return test::bone_on_ground("{ z = 19.5 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
         test::surface("floor", "ground", "plane") + test::layer("foot", "ball", "floor") +
         test::spring("rope", "[0, 0, -10]", "[0, 0, -10]", 5, 10) + test::load("press", "force = [0, 0, -1]") +
         test::step("prescribe = { \"j.a\" = 0, \"j.b\" = [0, 0.3], \"j.c\" = 0, \"j.x\" = 0, \"j.y\" = 0 }\n" +
                    control + "load = { press = [20, 200] }\nincrements = 3");
}

TEST(Path, StopsInTheMiddleOfAPoseAndTellsNothingOfIt) {
  for (const std::string control : {"", "control = \"arc_length\"\n"}) {
    const auto s = test::scene_model(soft_ball(control));
    const auto stopped_after = [&](int most, int& asked) {
      Followed out;
      ContactField field(s.model);
      PathObserver observer;
      observer.pose = [&](const PosePoint& p, LayerMemories*) { out.points.push_back(p); };
      observer.event = [&](const PathEvent& e) { out.events.push_back(e); };
      observer.cancelled = [&, most] { return ++asked > most; };
      out.result = follow_path(s.model, field, plan_steps(s.scene), {}, observer);
      return out;
    };
    int all = 0;
    const Followed whole = stopped_after(std::numeric_limits<int>::max(), all);
    ASSERT_TRUE(whole.result.complete) << whole.story();
    ASSERT_EQ(whole.points.size(), 4u);
    ASSERT_GT(all, 1000) << "not between rows alone";
    std::set<std::size_t> rows;
    for (int k = 0; k < 14; ++k) {
      int asked = 0;
      const int most = k < 3 ? k : static_cast<int>(static_cast<long>(all) * (k - 1) / 13);
      const Followed part = stopped_after(most, asked);
      EXPECT_FALSE(part.result.complete);
      EXPECT_LT(asked - most, 2000) << "goes on for long";
      ASSERT_LT(part.points.size(), 4u);
      rows.insert(part.points.size());
      for (std::size_t i = 0; i < part.points.size(); ++i) {
        EXPECT_TRUE(part.points[i].solved()) << part.story();
        EXPECT_EQ(part.points[i].pose.state.poses[1], whole.points[i].pose.state.poses[1]) << k;
      }
      ASSERT_LE(part.events.size(), whole.events.size()) << part.story();
      for (std::size_t i = 0; i < part.events.size(); ++i)
        EXPECT_EQ(part.events[i].kind, whole.events[i].kind) << part.story();
    }
    EXPECT_GE(rows.size(), 3u);
  }
}

}  // namespace
}  // namespace genu
