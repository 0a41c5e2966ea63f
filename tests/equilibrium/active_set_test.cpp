// The search for the contacts that carry load: dropped, added, kept under their numbers, certified; and refusals that
// leave the pose as it was.
#include "genu/equilibrium/active_set.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::held_ball;
using test::kLiftOff;
using test::kNoTurn;
using test::step;

/// A ball held to a floor, with the load that lifts it as the only thing to choose.
struct LiftedBall {
  test::SceneModel scene;
  ContactField field;
  ActiveSetSolver solver;
  Balanced pose;

  explicit LiftedBall(double z = 20)
      : scene(test::scene_model(held_ball(step("prescribe = { " + kNoTurn + " }"), z))),
        field(scene.model),
        solver(scene.model, field, {}) {
    pose.state = reference_state(scene.model);
    pose.last_number.assign(1, 0);
  }
  Target lifted(double load) const {
    Target target = test::target_of(scene.scene);
    target.load_factors = {load};
    return target;
  }
};

TEST(ActiveSet, AddsTheContactThatOverlaps) {
  LiftedBall bench(19.5);
  const PoseReport report = bench.solver.settle(bench.pose, bench.lifted(0));
  ASSERT_EQ(report.status, PoseStatus::ok) << report.why;
  ASSERT_EQ(bench.pose.state.contacts.size(), 1u);
  EXPECT_NEAR(bench.pose.state.contacts[0].force, kLiftOff, 1e-8);
  EXPECT_EQ(bench.pose.state.contacts[0].number, 1);
  EXPECT_NEAR(report.certificate.smallest_force, kLiftOff, 1e-8);
  EXPECT_NEAR(report.certificate.smallest_gap, 0, 1e-9);
  EXPECT_NEAR(report.certificate.least_opposed, -1, 1e-12);
  EXPECT_LT(report.certificate.residual, 1e-12);
}

TEST(ActiveSet, DropsTheContactThatPullsAndKeepsItsNumber) {
  LiftedBall bench(19.5);
  ASSERT_EQ(bench.solver.settle(bench.pose, bench.lifted(0)).status, PoseStatus::ok);
  const double load = kLiftOff + 0.5;
  ASSERT_EQ(bench.solver.settle(bench.pose, bench.lifted(load)).status, PoseStatus::ok);
  EXPECT_TRUE(bench.pose.state.contacts.empty());
  const double height = 0.018 * (1 + std::sqrt(load / 5000));
  EXPECT_NEAR(bench.pose.state.poses[1].p.z(), height, 1e-12);
  ASSERT_EQ(bench.pose.open.size(), 1u);
  EXPECT_EQ(bench.pose.open[0].number, 1);
  EXPECT_NEAR(bench.pose.open[0].gap, height - 0.02, 1e-12);
  ASSERT_EQ(bench.solver.settle(bench.pose, bench.lifted(20)).status, PoseStatus::ok);
  ASSERT_EQ(bench.pose.state.contacts.size(), 1u);
  EXPECT_EQ(bench.pose.state.contacts[0].number, 1);
  EXPECT_EQ(bench.pose.last_number[0], 1);
  EXPECT_TRUE(bench.pose.open.empty());
}

TEST(ActiveSet, HeldContactsAreJudgedNotChanged) {
  LiftedBall bench(19.5);
  ASSERT_EQ(bench.solver.settle(bench.pose, bench.lifted(0)).status, PoseStatus::ok);
  Findings findings;
  const PoseReport report = bench.solver.solve_held(bench.pose, bench.lifted(100), findings);
  ASSERT_TRUE(report.newton.converged());
  ASSERT_EQ(bench.pose.state.contacts.size(), 1u);
  EXPECT_NEAR(bench.pose.state.contacts[0].force, kLiftOff - 100, 1e-8);
  ASSERT_EQ(findings.pulling.size(), 1u);
  EXPECT_FALSE(findings.none());
  EXPECT_LT(findings.worst, 0);
}

TEST(ActiveSet, WhereALigamentLeavesItsPieceNoContactIsSearchedFor) {
  // A ball over a floor, held by a spring of 1 N/mm; beyond 5 mm a rope holds it too.
  auto s = test::scene_model(
      test::bone_on_ground("{ z = 40 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
      test::surface("floor", "ground", "plane") + test::contact("c", "ball", "floor") +
      test::spring("s", "[0, 0, 0]", "[0, 0, 20]", 1, 20) +
      test::ligament("rope", "[0, 0, 0]", "[0, 0, 20]", "law = \"linear\"\nstiffness = 2000\nslack_length = 25") +
      test::load("lift", "force = [0, 0, 1]") +
      test::step("prescribe = { \"j.x\" = 0, " + test::kNoTurn + " }\nload = { lift = [1, 15] }"));
  s.model.meter = std::make_shared<EffectMeter>();
  ContactField field(s.model);
  ActiveSetSolver solver(s.model, field, {});
  const StepPlan plan = plan_steps(s.scene).front();
  Balanced pose;
  pose.state = reference_state(s.model);
  pose.last_number.assign(1, 0);
  ASSERT_EQ(solver.settle_cold(pose, plan.target(0)).status, PoseStatus::ok);
  const auto searches = [&] { return s.model.meter->evaluations(Effect::contact_search); };
  const auto before = searches();
  Balanced beyond = pose;
  Findings findings;
  const PoseReport left = solver.solve_held(beyond, plan.target(1), findings);
  EXPECT_TRUE(left.newton.converged());
  EXPECT_EQ(findings.left_piece.size(), 1u);
  EXPECT_FALSE(findings.none());
  EXPECT_EQ(searches(), before);
  EXPECT_EQ(left.certificate.smallest_gap, 0) << "no certificate";
  // With its piece changed the pose is searched, and only then is it ok.
  const PoseReport settled = solver.settle(pose, plan.target(1));
  EXPECT_EQ(settled.status, PoseStatus::ok);
  EXPECT_EQ(searches(), before + 1);
  EXPECT_GT(settled.certificate.smallest_gap, 0.02);
}

TEST(ActiveSet, FailureLeavesThePoseAsItWas) {
  LiftedBall bench(19.5);
  ASSERT_EQ(bench.solver.settle(bench.pose, bench.lifted(0)).status, PoseStatus::ok);
  const Balanced before = bench.pose;
  Target impossible = bench.lifted(0);
  impossible.prescribed.push_back({{0, 5}, 0.01});  // into the floor
  const PoseReport report = bench.solver.settle(bench.pose, impossible);
  EXPECT_NE(report.status, PoseStatus::ok);
  EXPECT_EQ(bench.pose.state.poses[1].p, before.state.poses[1].p);
  EXPECT_EQ(bench.pose.state.contacts[0].force, before.state.contacts[0].force);
  EXPECT_EQ(bench.pose.state.multipliers, before.state.multipliers);
}

TEST(ActiveSet, ContactsMayTakeTheLastFreedom) {
  LiftedBall bench;
  EXPECT_EQ(bench.solver.contact_limit(bench.lifted(0)), 3);  // three angles and three contacts make six
  Target more = bench.lifted(0);
  for (int i = 3; i < 6; ++i) more.prescribed.push_back({{0, i}, 0});
  EXPECT_EQ(bench.solver.contact_limit(more), 0);
}

TEST(ActiveSet, ContactsThatNothingCanMoveForAreOverconstrained) {
  LiftedBall bench(19.5);
  Target into_the_floor = bench.lifted(0);
  for (int i = 3; i < 6; ++i) into_the_floor.prescribed.push_back({{0, i}, i == 5 ? 0.01 : 0});
  EXPECT_EQ(bench.solver.settle(bench.pose, into_the_floor).status, PoseStatus::overconstrained);
}

TEST(ActiveSet, ColdStartsMeet) {
  for (const double z : {15.0, 18.0, 20.0, 20.04, 21.0, 30.0}) {
    LiftedBall bench(z);
    const PoseReport report = bench.solver.settle_cold(bench.pose, bench.lifted(30));
    ASSERT_EQ(report.status, PoseStatus::ok) << z << ": " << report.why;
    ASSERT_EQ(bench.pose.state.contacts.size(), 1u) << z;
    EXPECT_LT((bench.pose.state.poses[1].p - Vec3(0, 0, 0.02)).norm(), 1e-9) << z;
    EXPECT_NEAR(bench.pose.state.contacts[0].force, kLiftOff - 30, 1e-8) << z;
  }
}

TEST(ActiveSet, ABallInACupHardlyLargerSettlesAlongItsLoad) {
  // Concentric at the start, with the same gap everywhere; only the contact's force gives the ball a stiffness. At
  // equilibrium its centre lies one clearance along the load.
  for (const double clearance : {0.001, 0.2, 4.0})
    for (const double force : {1.5, 1500.0, 150000.0}) {
      const Vec3 load = force * Vec3(0.2, 0.9, -0.3);
      const auto k = test::scene_model(fmt::format(R"(format = 1
units = {{ length = "mm", angle = "deg" }}
[body.pelvis]
fixed = true
[body.femur]
[joint.hip]
type = "free"
parent = "pelvis"
child = "femur"
rotations = ["flexion z", "adduction x", "rotation y"]
translations = ["x", "y", "z"]
[surface.head]
body = "femur"
shape = "sphere"
radius = 24
[surface.cup]
body = "pelvis"
shape = "sphere"
radius = {}
inside = true
z_axis = [0.2, 0.8, -0.55]
patch = {{ z = [2, 30] }}
[contact.hip]
surfaces = ["head", "cup"]
model = "rigid"
[load.weight]
body = "femur"
force = [{}, {}, {}]
[[step]]
prescribe = {{ "hip.flexion" = 0, "hip.adduction" = 0, "hip.rotation" = 0 }}
)",
                                                   24 + clearance, load.x(), load.y(), load.z()));
      ContactField field(k.model);
      ActiveSetSolver solver(k.model, field, {});
      Balanced pose;
      pose.state = reference_state(k.model);
      pose.last_number.assign(1, 0);
      const PoseReport report = solver.settle_cold(pose, test::target_of(k.scene));
      ASSERT_EQ(report.status, PoseStatus::ok) << clearance << " mm, " << force << " N: " << report.why;
      ASSERT_EQ(pose.state.contacts.size(), 1u);
      EXPECT_NEAR(pose.state.contacts[0].force, load.norm(), 1e-9 * load.norm());
      EXPECT_LT((pose.state.poses[1].p - 1e-3 * clearance * load.normalized()).norm(), 1e-11) << clearance;
    }
}

TEST(ActiveSet, KneeFromManyStartsMeets) {
  // Overlapping by millimetres, apart, shifted and turned: one pose.
  const auto k = test::solved_knee(0);
  ContactField field(k.scene.model);
  ActiveSetSolver solver(k.scene.model, field, {});
  for (const Vec6& off : {Vec6{0, 0, -5e-3, 0, 0, 0}, Vec6{0, 0, 10e-3, 0, 0, 0},
                          Vec6{2e-3, -3e-3, 1e-3, 0, 0.05, -0.1}, Vec6{0, 2e-3, -2e-3, 0, -0.06, 0.1}}) {
    Balanced pose;
    pose.state = reference_state(k.scene.model);
    pose.last_number.assign(2, 0);
    pose.state.poses[1] = retract(pose.state.poses[1], off);
    update_coordinates(k.scene.model, pose.state);
    const PoseReport report = solver.settle_cold(pose, k.target);
    ASSERT_EQ(report.status, PoseStatus::ok) << off.transpose() << ": " << report.why;
    EXPECT_LT((pose.state.poses[1].p - k.pose.state.poses[1].p).norm(), 1e-10) << off.transpose();
    EXPECT_LT((pose.state.poses[1].R - k.pose.state.poses[1].R).norm(), 1e-8) << off.transpose();
  }
}

}  // namespace
}  // namespace genu
