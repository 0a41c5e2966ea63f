// One step of the path by itself: substeps, located events, and the end of a path.
#include "genu/path/path_follower.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

struct Walking {
  test::SceneModel scene;
  PathOptions options;
  ContactField field;
  ActiveSetSolver solver;
  std::vector<PathEvent> events;
  std::function<void(PathEvent)> record = [this](PathEvent e) { events.push_back(e); };
  PathFollower follower;

  explicit Walking(const std::string& text)
      : scene(test::scene_model(text)),
        field(scene.model),
        solver(scene.model, field, options.newton),
        follower(solver, options, record) {
    Balanced pose;
    pose.state = reference_state(scene.model);
    pose.last_number.assign(scene.model.pairs.size(), 0);
    const StepPlan plan = plan_steps(scene.scene).front();
    const PoseReport report = solver.settle_cold(pose, plan.target(0));
    EXPECT_EQ(report.status, PoseStatus::ok) << report.why;
    follower.begin(plan, 1, pose, report);
  }
};

TEST(PathFollower, PassesALiftOffInsideItsStep) {
  Walking w(test::held_ball(test::step("prescribe = { " + test::kNoTurn + " }\nload = { lift = [0, 100] }")));
  ASSERT_TRUE(w.follower.advance_to(1));
  EXPECT_EQ(w.follower.t(), 1);
  ASSERT_EQ(w.events.size(), 1u);
  EXPECT_EQ(w.events[0].kind, PathEvent::Kind::contact_lost);
  EXPECT_NEAR(100 * w.events[0].t, test::kLiftOff, 1e-6);
  EXPECT_TRUE(w.follower.pose().state.contacts.empty());
  EXPECT_EQ(w.follower.stability().verdict, Stability::Verdict::stable);
}

TEST(PathFollower, StopsShortOfALimitPointWithTheLastGoodPose) {
  Walking w(test::bone_on_ground("{ z = 12 }") +
            test::ligament("l", "[0, 0, 0]", "[-40, 0, 0]", "law = \"spring\"\nstiffness = 50\nreference_force = 0") +
            test::ligament("r", "[0, 0, 0]", "[40, 0, 0]", "law = \"spring\"\nstiffness = 50\nreference_force = 0") +
            test::load("w", "force = [0, 0, -1]") +
            test::step("prescribe = { \"j.x\" = 0, \"j.y\" = 0, " + test::kNoTurn + " }\nload = { w = [0, 25] }"));
  EXPECT_FALSE(w.follower.advance_to(1));
  EXPECT_NEAR(25 * w.follower.t(), 19.899833915489113, 1e-4);
  EXPECT_TRUE(w.follower.turning_back());
  EXPECT_NE(w.follower.failure().status, PoseStatus::ok);
  EXPECT_EQ(w.follower.report().status, PoseStatus::ok);
  EXPECT_LT(w.follower.report().newton.residual, NewtonOptions{}.residual_floor);
}

TEST(PathFollower, PredictionFollowsASmoothPathInFewIterations) {
  Walking w(test::knee("[[step]]\nprescribe = { \"knee.flexion\" = [0, 60] }\n"));
  const int before = w.follower.iterations();
  for (int k = 1; k <= 60; ++k) ASSERT_TRUE(w.follower.advance_to(k / 60.0)) << k;
  for (const PathEvent& e : w.events)
    EXPECT_TRUE(e.kind == PathEvent::Kind::taut || e.kind == PathEvent::Kind::slack) << to_string(e.kind);
  // A degree each, and what it takes to locate where a ligament becomes taut or slack.
  EXPECT_LE(w.follower.iterations() - before, 4 * 60 + 20 * static_cast<int>(w.events.size()));
  EXPECT_FALSE(w.follower.turning_back());
}

/// The angle (rad) of a lever of 50 mm on a spring, which `force` (N) pulls toward a point of the ground: by bisection.
double lever_angle(double force) {
  const auto moment = [force](double angle) {
    const double x = -0.05 * std::sin(angle), y = 0.05 * std::cos(angle);
    return force * (x * (0.02 - y) - y * (0.06 - x)) / std::hypot(0.06 - x, 0.02 - y) - 0.2 * 180 / M_PI * angle;
  };
  double low = -1.2, high = 0;
  for (int i = 0; i < 60; ++i) (moment(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

TEST(PathFollower, RowsAboutASubstepApartLeaveNoSubstepOfRoundingLength) {
  for (const double force : {100.0, 145.0, 160.0, 400.0}) {
    Walking w(R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.lever]
[joint.hinge]
type = "revolute"
parent = "ground"
child = "lever"
axis = [0, 0, 1]
stiffness = 0.2
[load.muscle]
body = "lever"
point = [0, 50, 0]
toward = { body = "ground", point = [60, 20, 0] }
magnitude = )" +
              std::to_string(force) + "\n[[step]]\nload = { muscle = [0.1, 1] }\n");
    const int before = w.follower.iterations();
    for (int row = 1; row <= 10; ++row) {
      ASSERT_TRUE(w.follower.advance_to(row == 10 ? 1 : row * 0.1)) << force << " N, row " << row;
      const Mat3& R = w.follower.pose().state.poses.back().R;
      EXPECT_NEAR(std::atan2(R(1, 0), R(0, 0)), lever_angle(force * (0.1 + 0.09 * row)), 1e-9) << force;
    }
    EXPECT_LE(w.follower.iterations() - before, 8 * 10) << force;
  }
}

TEST(PathFollower, LocatesABifurcationInsideItsStep) {
  // A post on a hinge of stiffness c under a weight P at height h: upright it balances always, and c = P h is where it
  // no longer stands by itself.
  constexpr double kStiffness = 3, kHeight = 0.08;  // N m / rad, m
  Walking w(R"(format = 1
units = { length = "m", angle = "rad" }
[body.ground]
fixed = true
[body.post]
[joint.hinge]
type = "revolute"
parent = "ground"
child = "post"
axis = [0, 1, 0]
stiffness = 3
[load.weight]
body = "post"
force = [0, 0, -1]
point = [0, 0, 0.08]
[[step]]
load = { weight = [0, 100] }
)");
  ASSERT_TRUE(w.follower.advance_to(1));
  ASSERT_EQ(w.events.size(), 2u);
  EXPECT_EQ(w.events[0].kind, PathEvent::Kind::bifurcation);
  EXPECT_EQ(w.events[1].kind, PathEvent::Kind::stability_changed);
  EXPECT_EQ(w.events[1].what, "unstable");
  EXPECT_NEAR(100 * w.events[0].t, kStiffness / kHeight, 1e-7);
  EXPECT_NEAR(w.follower.stability().smallest, kStiffness - 100 * kHeight, 1e-9);
}

TEST(PathFollower, LocatesWhereAReactionIsLargest) {
  // The truss whose height is prescribed: its load is largest at the limit point of its load-driven path.
  Walking w(test::bone_on_ground("{ z = 12 }") +
            test::ligament("l", "[0, 0, 0]", "[-40, 0, 0]", "law = \"spring\"\nstiffness = 50\nreference_force = 0") +
            test::ligament("r", "[0, 0, 0]", "[40, 0, 0]", "law = \"spring\"\nstiffness = 50\nreference_force = 0") +
            test::step("prescribe = { \"j.y\" = 0, \"j.z\" = [12, -12], " + test::kNoTurn + " }"));
  ASSERT_TRUE(w.follower.advance_to(1));
  std::vector<double> heights;
  for (const PathEvent& e : w.events)
    if (e.kind == PathEvent::Kind::reaction_turns) heights.push_back(1e3 * e.coordinates[0][5]);
  ASSERT_EQ(heights.size(), 2u);
  const double critical = std::cbrt(std::hypot(40.0, 12.0) * 1600), z = std::sqrt(critical * critical - 1600);
  EXPECT_NEAR(heights[0], z, 1e-6);
  EXPECT_NEAR(heights[1], -z, 1e-6);
}

}  // namespace
}  // namespace genu
