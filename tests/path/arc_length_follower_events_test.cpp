// What lies on the way of a path: kinks and jumps of laws, changes of contact at a row's very place, bifurcations,
// flutter, limit points near each other. Each against a closed form, by arc length and by values, in many increments
// and in one.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/path/arc_length_follower.h"
#include "support/solved.h"

namespace genu {
namespace {

using test::follow;
using test::Followed;
using test::kNoTurn;
using Kind = PathEvent::Kind;

const std::string kArc = "control = \"arc_length\"\n";
const std::string kOnlyZ = "prescribe = { \"j.x\" = 0, \"j.y\" = 0, " + kNoTurn + " }\n";

/// A bone at 0 on a spring of 10 N/mm along z, 50 mm above the foot of a ligament with the given law, pulled up with 80
/// N and let down again.
std::string pulled(const std::string& law, const std::string& control) {
  return test::bone_on_ground("{ z = 0 }") +
         test::ligament("base", "[0, 0, 0]", "[0, 0, -100]", "law = \"spring\"\nstiffness = 10\nreference_force = 0") +
         test::ligament("rope", "[0, 0, 0]", "[0, 0, -50]", law) + test::load("w", "force = [0, 0, 1]") +
         test::step(kOnlyZ + control + "load = { w = [0, 80] }\nincrements = 4") +
         test::step(kOnlyZ + control + "load = { w = [80, 0] }\nincrements = 4");
}

TEST(ArcLengthFollowerEvents, AKinkOfALawIsPassedUpAndDown) {
  const Followed w = follow(pulled("law = \"linear\"\nstiffness = 500\nslack_length = 51", kArc));
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.points.size(), 9u) << w.story();
  const auto taut = w.of(Kind::taut), slack = w.of(Kind::slack);
  ASSERT_EQ(taut.size(), 1u) << w.story();
  ASSERT_EQ(slack.size(), 1u) << w.story();
  EXPECT_NEAR(taut[0].t, 10.0 / 80, 2e-9);
  EXPECT_NEAR(slack[0].t, 70.0 / 80, 2e-9);
  for (const PosePoint& p : w.points) {
    const double load = p.target.load_factors[0], z = 1e3 * p.pose.state.poses[1].p.z();
    EXPECT_NEAR(z, load < 10 ? load / 10 : 1 + (load - 10) / (10 + 500.0 / 51), 1e-9) << load;
  }
}

TEST(ArcLengthFollowerEvents, ADropOfTheForceIsFollowedDownTheDrop) {
  // Up to 2.015 mm (a strain of 0.03) the force is 10 x^2 N, x mm beyond 50.5; from there 5 (x - 0.015 * 50.5) N. The
  // load turns back from 20.15 + 22.95225 N to 20.15 + 3.7875 N at that height, unstable, and grows again.
  const Followed w = follow(
      pulled("law = \"abdel-rahman\"\nstiffness = 5\ntoe_stiffness = 10\ntransition_strain = 0.03\nslack_length = 50.5",
             kArc));
  ASSERT_TRUE(w.result.complete) << w.story();
  const auto limits = w.of(Kind::limit_point);
  ASSERT_EQ(limits.size(), 4u) << w.story();
  const double above = 20.15 + 22.95225, below = 20.15 + 3.7875;
  const double truth[] = {above, below, below, above};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(limits[i].target.load_factors[0], truth[i], 2e-7) << i;
    EXPECT_NEAR(1e3 * limits[i].coordinates[0][5], 2.015, 1e-7) << i;
  }
  int unstable = 0;
  for (const PosePoint& p : w.points) unstable += p.stability.verdict == Stability::Verdict::unstable;
  EXPECT_EQ(unstable, 2) << "40 N on the drop, once each way";
  EXPECT_EQ(w.points.size(), 13u);
  EXPECT_EQ(w.of(Kind::held).size(), 2u);
  EXPECT_EQ(w.of(Kind::transition).size(), 2u);
}

TEST(ArcLengthFollowerEvents, ARiseOfTheForceIsHeldAsByValues) {
  const std::string law =
      "law = \"abdel-rahman\"\nstiffness = 40\ntoe_stiffness = 10\ntransition_strain = 0.03\nslack_length = 50.5";
  const Followed arc = follow(pulled(law, kArc)), values = follow(pulled(law, ""));
  ASSERT_TRUE(arc.result.complete) << arc.story();
  ASSERT_EQ(arc.points.size(), values.points.size());
  for (std::size_t i = 0; i < arc.points.size(); ++i)
    EXPECT_NEAR(arc.points[i].pose.state.poses[1].p.z(), values.points[i].pose.state.poses[1].p.z(), 1e-12) << i;
  ASSERT_EQ(arc.events.size(), values.events.size()) << arc.story() << values.story();
  for (std::size_t i = 0; i < arc.events.size(); ++i) {
    EXPECT_EQ(arc.events[i].kind, values.events[i].kind) << i;
    EXPECT_NEAR(arc.events[i].t, values.events[i].t, 2e-9) << i;
  }
}

/// The held ball of solved.h is let go by exactly `share` of the step's load.
Followed lifted(double share, const std::string& control) {
  return follow(test::held_ball(test::step("prescribe = { " + kNoTurn + " }\n" + control + "load = { lift = [0, " +
                                           fmt::format("{:.17g}", test::kLiftOff / share) + "] }\nincrements = 4")));
}

TEST(ArcLengthFollowerEvents, NoRowIsLostWhereAContactChangesAtIt) {
  for (const double share : {0.25, 0.5, 0.5 + 1e-10, 0.5 - 1e-10, 1 - 1e-7, 1.0, 1 + 1e-10}) {
    const Followed w = lifted(share, kArc);
    ASSERT_TRUE(w.result.complete) << share << w.story();
    ASSERT_EQ(w.points.size(), 5u) << share;
    for (int k = 0; k < 5; ++k) {
      EXPECT_EQ(w.points[static_cast<std::size_t>(k)].increment, k) << share;
      EXPECT_NEAR(w.points[static_cast<std::size_t>(k)].t, k / 4.0, 1e-12) << share;
    }
  }
}

/// A column: a link of 50 mm on a hinge of 1 N m/rad under a dead load of up to 60 N, `aside` of it sideways. It
/// buckles at 20 N.
std::string column(double aside, const std::string& step) {
  return "format = 1\nunits = { length = \"mm\", angle = \"rad\" }\n[body.ground]\nfixed = true\n[body.link]\n"
         "[joint.h]\ntype = \"revolute\"\nparent = \"ground\"\nchild = \"link\"\naxis = [0, 1, 0]\nstiffness = 1\n"
         "[load.f]\nbody = \"link\"\npoint = [0, 0, 50]\nforce = [" +
         fmt::format("{:.17g}", aside) + ", 0, -1]\n[[step]]\nload = { f = [0, 60] }\n" + step;
}

TEST(ArcLengthFollowerEvents, AColumnBifurcatesWhereItBuckles) {
  for (const std::string& control : {std::string(), kArc})
    for (const int increments : {1, 3, 7, 100}) {  // of three, the first ends there
      const Followed w = follow(column(0, control + "increments = " + std::to_string(increments)));
      ASSERT_EQ(w.points.size(), static_cast<std::size_t>(increments) + 1) << w.story();
      ASSERT_EQ(w.of(Kind::bifurcation).size(), 1u) << control << increments << w.story();
      EXPECT_NEAR(w.of(Kind::bifurcation)[0].t, 1.0 / 3, 2e-9) << control << increments;
    }
}

TEST(ArcLengthFollowerEvents, AnImperfectColumnKeepsToItsOwnSide) {
  // Never through the gap to the unstable branch of the other side, however narrow it is.
  for (const std::string& control : {std::string(), kArc})
    for (const int increments : {1, 7, 100})
      for (const double aside : {1e-3, 1e-6, 1e-9}) {
        const Followed w = follow(column(aside, control + "increments = " + std::to_string(increments)));
        ASSERT_TRUE(w.result.complete) << w.story();
        EXPECT_TRUE(w.events.empty()) << control << increments << " " << aside << w.story();
        const double angle = w.points.back().pose.state.coordinates[0][0];
        EXPECT_GT(angle, 2) << control << increments << " " << aside;
        EXPECT_NEAR(angle, 3 * (std::sin(angle) + aside * std::cos(angle)), 1e-10);
        EXPECT_EQ(w.points.back().stability.verdict, Stability::Verdict::stable)
            << control << increments << " " << aside;
      }
}

TEST(ArcLengthFollowerEvents, FlutterIsLocatedInAnyIncrements) {
  // Ziegler's column: two links of 50 mm on hinges of 1 N m/rad under a follower of up to 1000 N. In the metric of the
  // eigenvalues, 26 phi1^2 + phi2^2, they are complex from p = P l / c = 28 - 52 / sqrt(26) on, within one substep or
  // not.
  const double onset = 20 * (28 - 52 / std::sqrt(26.0)) / 1000, unstable = 0.56;  // 2 - p + 26 = 0
  const auto joint = [](const char* name, const char* parent, const char* child, const char* origin) {
    return fmt::format(
        "[joint.{}]\ntype = \"revolute\"\nparent = \"{}\"\nchild = \"{}\"\norigin = {}\naxis = [0, 1, 0]\nstiffness = "
        "1\n",
        name, parent, child, origin);
  };
  const std::string head =
      "format = 1\nunits = { length = \"mm\", angle = \"rad\" }\n[body.ground]\nfixed = true\n[body.p]\n[body.q]\n" +
      joint("h", "ground", "p", "[0, 0, 0]") + joint("k", "p", "q", "[0, 0, 50]") +
      "[load.f]\nbody = \"q\"\npoint = [0, 0, 50]\nforce = [0, 0, -1]\nframe = \"body\"\n[[step]]\nload = { f = [0, "
      "1000] "
      "}\n";
  for (const std::string& control : {std::string(), kArc})
    for (const int increments : {1, 7, 100}) {
      const Followed w = follow(head + control + "increments = " + std::to_string(increments));
      ASSERT_TRUE(w.result.complete) << w.story();
      ASSERT_EQ(w.of(Kind::flutter).size(), 1u) << control << increments << w.story();
      EXPECT_NEAR(w.of(Kind::flutter)[0].t, onset, 1e-8) << control << increments;
      ASSERT_FALSE(w.of(Kind::stability_changed).empty()) << control << increments << w.story();
      EXPECT_NEAR(w.of(Kind::stability_changed).back().t, unstable, 1e-8) << control << increments;
      EXPECT_TRUE(w.of(Kind::bifurcation).empty()) << control << increments;
    }
}

/// A truss of 40 mm half span and 12 mm rise, propped by a spring that takes all but `gap` of its negative stiffness:
/// two limit points, the nearer the smaller the gap.
struct ProppedTruss {
  double rest = std::hypot(0.04, 0.012), critical = 100e3 * (rest / 0.04 - 1), prop;
  explicit ProppedTruss(double gap) : prop(critical * (1 - gap)) {}

  double load(double z) const { return 100e3 * z * (rest / std::hypot(0.04, z) - 1) + prop * (0.012 - z); }
  double slope(double z) const {
    return 100e3 * (rest / std::hypot(0.04, z) - 1 - rest * z * z / std::pow(std::hypot(0.04, z), 3)) - prop;
  }
  double limit() const {  // by bisection; the other is its mirror image
    double low = 0, high = 0.012;
    for (int i = 0; i < 100; ++i) (slope(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
    return low;
  }
  std::string scene(const std::string& step) const {
    const std::string bar = "law = \"spring\"\nstiffness = 50\nreference_force = 0";
    return test::bone_on_ground("{ z = 12 }") + test::ligament("l", "[0, 0, 0]", "[-40, 0, 0]", bar) +
           test::ligament("r", "[0, 0, 0]", "[40, 0, 0]", bar) +
           test::ligament("prop", "[0, 0, 0]", "[0, 0, 12]",
                          fmt::format("law = \"spring\"\nstiffness = {:.17g}\nslack_length = 0", 1e-3 * prop)) +
           test::load("w", "force = [0, 0, -1]") +
           test::step(kOnlyZ + fmt::format("load = {{ w = [0, {:.17g}] }}\n", prop * 0.024) + step);
  }
};

TEST(ArcLengthFollowerEvents, LimitPointsNearEachOtherAreSeenInAnyIncrements) {
  for (const double gap : {0.3, 0.01, 1e-3}) {
    const ProppedTruss truss(gap);
    const double z = truss.limit();
    for (const int increments : {1, 7, 100}) {
      const Followed arc = follow(truss.scene(kArc + "increments = " + std::to_string(increments)));
      ASSERT_TRUE(arc.result.complete) << arc.story();
      ASSERT_EQ(arc.of(Kind::limit_point).size(), 2u) << gap << " " << increments << arc.story();
      EXPECT_NEAR(arc.of(Kind::limit_point)[0].coordinates[0][5], z, 1e-9);
      EXPECT_NEAR(arc.of(Kind::limit_point)[1].coordinates[0][5], -z, 1e-9);
      EXPECT_NEAR(arc.of(Kind::limit_point)[0].target.load_factors[0], truss.load(z), 1e-9);
      const Followed values = follow(truss.scene("increments = " + std::to_string(increments)));
      ASSERT_EQ(values.of(Kind::turns_back).size(), 1u) << gap << " " << increments << values.story();
      EXPECT_NEAR(values.of(Kind::turns_back)[0].coordinates[0][5], z, 1e-9);
      EXPECT_TRUE(values.of(Kind::bifurcation).empty()) << gap << " " << increments << values.story();
      EXPECT_FALSE(values.result.complete);
    }
  }
}

TEST(ArcLengthFollowerEvents, WhereNothingTurnsBackNoLimitIsClaimed) {
  const ProppedTruss truss(-1e-5);  // all but vertical at z = 0
  for (const int increments : {1, 7, 100}) {
    EXPECT_TRUE(follow(truss.scene(kArc + "increments = " + std::to_string(increments))).result.complete);
    const Followed values = follow(truss.scene("increments = " + std::to_string(increments)));
    EXPECT_TRUE(values.of(Kind::turns_back).empty()) << values.story();
  }
}

TEST(ArcLengthFollowerEvents, TheReactionTurnsByArcLengthAsByValues) {
  const auto at = [](const std::string& control) {
    return follow(test::knee("[[step]]\nprescribe = { \"knee.flexion\" = [0, 90] }\nincrements = 9\n" + control));
  };
  const auto values = at("").of(Kind::reaction_turns), arc = at(kArc).of(Kind::reaction_turns);
  ASSERT_EQ(values.size(), 1u);
  ASSERT_EQ(arc.size(), 1u);
  EXPECT_NEAR(arc[0].t, values[0].t, 1e-8);
  EXPECT_EQ(arc[0].what.substr(0, 7), values[0].what.substr(0, 7));
}

TEST(ArcLengthFollowerEvents, TheWayBackIsNoWayOn) {
  // Two ligaments at the same jump: which carries how much of the rise is not determined, and the path ends there. It
  // does not turn round and run back along the branch it came on.
  const std::string law =
      "law = \"abdel-rahman\"\nstiffness = 40\ntoe_stiffness = 10\ntransition_strain = 0.03\nslack_length = 50.5";
  const Followed w = follow(test::ligament("twin", "[0, 0, 0]", "[0, 0, -50]", law).insert(0, pulled(law, kArc)));
  EXPECT_FALSE(w.result.complete);
  EXPECT_TRUE(w.of(Kind::limit_point).empty()) << w.story();
  EXPECT_TRUE(w.of(Kind::slack).empty()) << w.story();
  ASSERT_EQ(w.of(Kind::stopped).size(), 1u) << w.story();
  EXPECT_NEAR(w.of(Kind::stopped)[0].t, (20.15 + 2 * 22.95225) / 80, 1e-8);
}

}  // namespace
}  // namespace genu
