// Chains of bodies on revolute and fixed joints, and combinations of coordinates, against closed forms.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "genu/model/build_model.h"
#include "genu/model/linearization.h"
#include "support/finite_difference.h"
#include "support/solved.h"

namespace genu {
namespace {

/// The zero of f between two places of different sign.
double bisect(const std::function<double(double)>& f, double low, double high) {
  const bool rising = f(high) > 0;
  EXPECT_NE(f(low) > 0, rising) << "no sign change";
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0) == rising ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// ground - one - two, two hinges of stiffness 2 and 1 N m/rad; the second stands at `link` of `one`.
std::string two_links(const std::string& axis, const std::string& link, const std::string& more) {
  const auto hinge = [&](const std::string& name, const std::string& parent, const std::string& child,
                         const std::string& rest) {
    return "[joint." + name + "]\ntype = \"revolute\"\nparent = \"" + parent + "\"\nchild = \"" + child +
           "\"\naxis = " + axis + "\n" + rest + "\n";
  };
  return R"(format = 1
units = { length = "mm", angle = "rad" }
[body.ground]
fixed = true
[body.one]
[body.two]
)" + hinge("h1", "ground", "one", "stiffness = 2") +
         hinge("h2", "one", "two", "stiffness = 1\norigin = " + link) + more;
}

TEST(JointConstraints, TwoLinksUnderADeadLoad) {
  // Links of 90 and 60 mm along e1, hinges about a; the load is 12 e1 + 30 e2 + 9 a (N).
  const Vec3 a = Vec3(1, 2, 2) / 3, e1 = Vec3(2, 1, -2) / 3, e2 = a.cross(e1), force(-9, 30, -12);
  const test::Followed w = test::follow(two_links("[2, 4, 4]", "[60, 30, -60]", R"([load.pull]
body = "two"
force = [-9, 30, -12]
point = [40, 20, -40]
[[step]]
load = { pull = [0, 1] }
increments = 4
)"));
  ASSERT_TRUE(w.result.complete) << w.story();
  const State& state = w.points.back().pose.state;

  // With f the direction of the second link the moment about the second hinge gives its angle, that about the first the
  // equation for f.
  const double l1 = 0.09, l2 = 0.06, k1 = 2, k2 = 1, f1 = 12, f2 = 30;
  const auto moment = [&](double l, double direction) {
    return l * (std::cos(direction) * f2 - std::sin(direction) * f1);
  };
  const auto second = [&](double f) { return moment(l2, f) / k2; };
  const double f =
      bisect([&](double x) { return k1 * (x - second(x)) - moment(l1, x - second(x)) - moment(l2, x); }, 0, 1.5);
  const double q2 = second(f), q1 = f - q2;
  EXPECT_NEAR(state.coordinates[0][0], q1, 1e-11);
  EXPECT_NEAR(state.coordinates[1][0], q2, 1e-11);
  EXPECT_GT(q1, 0.5) << "a large motion, or the test says little";
  const Vec3 tip = l1 * (std::cos(q1) * e1 + std::sin(q1) * e2) + l2 * (std::cos(f) * e1 + std::sin(f) * e2);
  EXPECT_LT((state.poses[2] * Vec3(0.04, 0.02, -0.04) - tip).norm(), 1e-12);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_NEAR(state.coordinates[0][i], 0, 1e-12) << i;

  // The first hinge holds back the load and its moment, all but the part about the axis.
  const JointModel model = test::scene_model(two_links("[2, 4, 4]", "[60, 30, -60]", "")).model;
  const Vec6 first = joint_reaction(model, state, 0);
  const Vec3 whole = tip.cross(force);
  EXPECT_LT((first.head<3>() + force).norm(), 1e-9);
  EXPECT_LT((first.tail<3>() + whole - a.dot(whole) * a).norm(), 1e-9);
  // The second does it in the axes of the first link.
  const Vec6 next = joint_reaction(model, state, 1);
  EXPECT_LT((next.head<3>() + state.poses[1].R.transpose() * force).norm(), 1e-9);
  EXPECT_NEAR(next.tail<3>().dot(a), 0, 1e-9);
}

TEST(JointConstraints, AFixedJointPassesTheLoadOn) {
  const std::string text = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.arm]
[body.hand]
[joint.elbow]
type = "revolute"
parent = "ground"
child = "arm"
axis = [0, 0, 1]
stiffness = 0.3
reference = { angle = 20 }
[joint.wrist]
type = "fixed"
parent = "arm"
child = "hand"
origin = [100, 0, 10]
[load.weight]
body = "hand"
force = [0, -20, 5]
moment = [0.1, 0.2, 0.3]
point = [30, 10, 0]
[[step]]
load = { weight = [0, 1] }
)";
  const test::SceneModel s = test::scene_model(text);
  const test::Followed w = test::follow(text);
  ASSERT_TRUE(w.result.complete) << w.story();
  const State& state = w.points.back().pose.state;
  const Vec3 force(0, -20, 5), moment(0.1, 0.2, 0.3);
  const Mat3 R = state.poses[1].R;
  EXPECT_GT((R - Mat3::Identity()).norm(), 0.05);
  EXPECT_LT((state.poses[2].R - R).norm(), 1e-12);
  EXPECT_LT((state.poses[2].p - R * Vec3(0.1, 0, 0.01)).norm(), 1e-12);
  const Vec6 reaction = joint_reaction(s.model, state, 1);
  EXPECT_LT((R * reaction.head<3>() + force).norm(), 1e-9);
  EXPECT_LT((R * reaction.tail<3>() + moment + (R * Vec3(0.03, 0.01, 0)).cross(force)).norm(), 1e-9);
  EXPECT_EQ(w.points.back().stability.free_motions, 1);
  EXPECT_EQ(w.points.back().stability.verdict, Stability::Verdict::stable);

  // Poses of other origins: the reaction is told about the hand's own.
  const PlacedScene moved = place(s.source, {Vec3::Zero(), Vec3(0.02, -0.03, 0.04), Vec3(-0.05, 0.01, 0.03)});
  Diagnostics out;
  const auto model = build_model(moved, {}, out);
  ASSERT_TRUE(model.has_value());
  const test::Followed again = test::follow(*model, plan_steps(moved));
  ASSERT_TRUE(again.result.complete) << again.story();
  EXPECT_LT((joint_reaction(*model, again.points.back().pose.state, 1) - reaction).norm(), 1e-9);
  EXPECT_NEAR(again.points.back().stability.smallest / w.points.back().stability.smallest, 1, 1e-9);
}

TEST(JointConstraints, AChainStandsOnItsLastBody) {
  // The end of two links of 100 and 80 mm is a ball of 10 mm that a load of 20 N presses on a floor 60 mm below.
  const std::string text =
      two_links("[0, 0, 1]", "[100, 0, 0]",
                test::surface("ball", "two", "sphere", "radius = 10\norigin = [80, 0, 0]") +
                    test::surface("floor", "ground", "plane", "origin = [0, -60, 0]\nz_axis = [0, 1, 0]") +
                    test::contact("foot", "ball", "floor") + R"([load.weight]
body = "two"
force = [0, -20, 0]
point = [80, 0, 0]
[[step]]
load = { weight = [0, 1] }
increments = 10
)");
  const test::Followed w = test::follow(text);
  ASSERT_TRUE(w.result.complete) << w.story();
  EXPECT_EQ(w.of(PathEvent::Kind::contact_gained).size(), 1u) << w.story();
  const State& state = w.points.back().pose.state;
  ASSERT_EQ(state.contacts.size(), 1u);

  const double l1 = 0.1, l2 = 0.08, k1 = 2, k2 = 1;
  const auto first = [&](double f) { return std::asin((-0.05 - l2 * std::sin(f)) / l1); };
  const auto net = [&](double f) { return k2 * (f - first(f)) / (l2 * std::cos(f)); };  // force up at the ball
  const double f =
      bisect([&](double x) { return k1 * first(x) - (l1 * std::cos(first(x)) + l2 * std::cos(x)) * net(x); }, -0.6, 0);
  EXPECT_NEAR(state.coordinates[0][0], first(f), 1e-11);
  EXPECT_NEAR(state.coordinates[1][0], f - first(f), 1e-11);
  EXPECT_NEAR(state.contacts[0].force, 20 + net(f), 1e-8);
  EXPECT_GT(state.contacts[0].force, 1);
}

TEST(JointConstraints, ACombinationSharesItsMomentByItsFactors) {
  // 3 q1 - q2 = 1 rad at no load: k1 q1 = 3 mu, k2 q2 = -mu.
  const std::string text = two_links("[0, 0, 1]", "[100, 0, 0]", R"([combination.mix]
terms = { "h1.angle" = 3, "h2.angle" = -1 }
[[step]]
prescribe = { mix = [0, 1] }
increments = 3
)");
  const test::Followed w = test::follow(text);
  ASSERT_TRUE(w.result.complete) << w.story();
  const State& state = w.points.back().pose.state;
  const double mu = 1 / (9.0 / 2 + 1);
  EXPECT_NEAR(state.multipliers[0], mu, 1e-11);
  EXPECT_NEAR(state.coordinates[0][0], 3 * mu / 2, 1e-11);
  EXPECT_NEAR(state.coordinates[1][0], -mu, 1e-11);
}

/// What the springs of a model have stored, J.
double stored(const JointModel& model, const std::vector<JointValues>& coordinates) {
  const std::vector<Pose> poses = poses_from_coordinates(model, coordinates);
  double energy = 0;
  for (const auto& l : model.ligaments) energy += l.law.evaluate(l.path.length(poses)).energy;
  return energy;
}

TEST(JointConstraints, ACombinationOfAFreeJointDoesTheWorkOfItsReaction) {
  // A bone on six springs turns twice as far about c as about a while a is driven.
  std::string text = test::bone_on_ground("{ z = 40 }");
  const char* const points[][2] = {{"[30, 0, 0]", "[45, 5, -60]"},       {"[-20, 25, 0]", "[-30, 40, -50]"},
                                   {"[-20, -25, 5]", "[-35, -20, -55]"}, {"[0, 30, 10]", "[60, 50, 20]"},
                                   {"[10, 0, 30]", "[-50, 20, 80]"},     {"[5, -20, 20]", "[30, -70, 60]"}};
  int k = 0;
  for (const auto& p : points) {
    ++k;
    text += test::spring("s" + std::to_string(k), p[0], p[1], 2 + k, 50 + 4 * k);
  }
  text += R"([combination.screw]
terms = { "j.a" = -2, "j.c" = 1 }
[combination.heave]
terms = { "j.x" = 1, "j.z" = 3 }
[[step]]
prescribe = { screw = 0, "j.a" = [0, 0.2], heave = [120, 125] }
increments = 4
)";
  const test::SceneModel s = test::scene_model(text);
  const test::Followed w = test::follow(text);
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.points.size(), 5u);
  double worst = 0;
  for (const PosePoint& point : w.points) {
    const State& state = point.pose.state;
    const JointValues& q = state.coordinates[0];
    EXPECT_NEAR(q[2] - 2 * q[0], 0, 1e-12);
    EXPECT_NEAR(q[3] + 3 * q[5], point.target.prescribed[2].value, 1e-13);
    const double screw = state.multipliers[0], drive = state.multipliers[1], heave = state.multipliers[2];
    const double reaction[6] = {-2 * screw + drive, 0, screw, heave, 0, 3 * heave};
    for (std::size_t i = 0; i < 6; ++i) {
      const auto energy = [&](double change) {
        auto coordinates = state.coordinates;
        coordinates[0][i] += change;
        return stored(s.model, coordinates);
      };
      const double scale = i < 3 ? 1.0 : 100.0;  // N m, N
      worst = std::max(worst, std::abs(test::derivative(energy, i < 3 ? 1e-3 : 1e-5) - reaction[i]) / scale);
    }
    EXPECT_GT(std::abs(screw), 1e-3);
    EXPECT_GT(std::abs(heave), 1);
  }
  EXPECT_LT(worst, 1e-8) << "worst error of a generalised reaction, N m or 100 N";
}

TEST(JointConstraints, AStrutOfTwoLinksBuckles) {
  // Pushed along its axis with P, the straight strut's second variation in (q1, q2) is singular where
  // k1 k2 - P (k1 l2 + k2 (l1 + l2)) + P^2 l1 l2 = 0. The hinge between the links moves with the first one: the
  // curvature of what it holds is part of that.
  const double l1 = 0.1, l2 = 0.08, k1 = 2, k2 = 1, b = k1 * l2 + k2 * (l1 + l2);
  const double critical = (b - std::sqrt(b * b - 4 * l1 * l2 * k1 * k2)) / (2 * l1 * l2);
  const test::Followed w = test::follow(two_links("[0, 0, 1]", "[100, 0, 0]", R"([load.push]
body = "two"
force = [-1, 0, 0]
point = [80, 0, 0]
[[step]]
load = { push = [7, 7.1] }
increments = 40
)"));
  ASSERT_TRUE(w.result.complete) << w.story();
  int stable = 0;
  for (const PosePoint& p : w.points) {
    const double push = p.target.load_factors[0];
    stable += push < critical ? 1 : 0;
    EXPECT_EQ(p.stability.verdict, push < critical ? Stability::Verdict::stable : Stability::Verdict::unstable)
        << push << " N, critical " << critical << " N, eigenvalue " << p.stability.smallest;
    EXPECT_EQ(p.stability.free_motions, 2);
  }
  EXPECT_GT(stable, 5);
  EXPECT_LT(stable, 36);
}

TEST(JointConstraints, StepsMayPrescribeDifferentThings) {
  const std::string text = two_links("[0, 0, 1]", "[100, 0, 0]", R"([combination.mix]
terms = { "h1.angle" = 1, "h2.angle" = 1 }
[load.weight]
body = "two"
force = [0, -10, 0]
[[step]]
prescribe = { mix = [0, 0.5] }
[[step]]
increments = 2
[[step]]
prescribe = { "h1.angle" = [0, 0.3] }
)");
  const test::Followed w = test::follow(text);
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.points.size(), 5u);
  const State &coupled = w.points[1].pose.state, &loose = w.points[3].pose.state, &driven = w.points[4].pose.state;
  EXPECT_NEAR(coupled.coordinates[0][0] + coupled.coordinates[1][0], 0.5, 1e-12);
  EXPECT_NEAR(loose.coordinates[1][0], 0, 1e-11) << "the load acts at the second hinge";
  EXPECT_NEAR(2 * loose.coordinates[0][0], -10 * 0.1 * std::cos(loose.coordinates[0][0]), 1e-11);
  EXPECT_NEAR(driven.coordinates[0][0], 0.3, 1e-12);
  EXPECT_NEAR(driven.multipliers[0], 2 * 0.3 + 10 * 0.1 * std::cos(0.3), 1e-11);
}

}  // namespace
}  // namespace genu
