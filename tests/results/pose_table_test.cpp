// Rows and columns from poses made by hand, whose numbers are known.
#include "genu/results/pose_table.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/scene_model.h"

namespace genu {
namespace {

constexpr double kDegree = M_PI / 180;

/// Two balls over a floor; `foot` has two regions, `cord` no slack length.
struct Bench {
  test::SceneModel scene = test::scene_model(
      test::bone_on_ground("{ z = 20 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
      test::surface("knob", "bone", "sphere", "radius = 5") + test::surface("floor", "ground", "plane") +
      test::contact("foot", "ball", "floor") + "regions = { left = \"x < 0\", right = \"x >= 0\" }\n" +
      test::contact("toe", "knob", "floor") + test::spring("cord", "[0, 0, 0]", "[0, 0, 0]", 1, 0) +
      test::spring("rope", "[0, 0, 0]", "[0, 0, -5]", 2, 20) + test::load("lift", "force = [0, 0, 1]") +
      test::step("prescribe = { \"j.a\" = [0, 1] }\nincrements = 2") +
      test::step("prescribe = { \"j.x\" = [0, 1] }\nload = { lift = [0, 1] }"));
  std::vector<StepPlan> steps;
  std::vector<PoseRecord> records;
  Pose bone{exp_rotation({0, 0, 0.5 * M_PI}), Vec3(0, 0, 0.02)};

  Bench() {
    steps.resize(2);
    steps[0].prescribed = {{{0, 0}, 0, 1}};
    steps[1].prescribed = {{{0, 3}, 0, 1e-3}};
  }
  PosePoint& add(int step, double prescribed, double multiplier) {
    PoseRecord r;
    r.point.step = step;
    r.point.report.status = PoseStatus::ok;
    r.point.target.prescribed = {{{0, step == 1 ? 0 : 3}, prescribed}};
    r.point.pose.state = reference_state(scene.model);
    r.point.pose.state.poses[1] = bone;
    r.point.pose.state.multipliers = {multiplier};
    r.point.pose.last_number = {0, 0};
    r.pair_gap = {1e-4, 2e-4};
    records.push_back(r);
    return records.back().point;
  }
  /// Facing points: `b` on the floor (m), the ball's straight below it by `gap`.
  ContactGeometry facing(const Vec3& b, double gap) const {
    ContactGeometry g;
    g.b.p = b;
    g.a.p = bone.inverse() * (b + gap * Vec3::UnitZ());
    g.a.n = -Vec3::UnitZ();
    return g;
  }
  void close(PosePoint& p, int pair, int number, const Vec3& b, double force) const {
    p.pose.state.contacts.push_back({pair, number, facing(b, 3e-6), force});
    auto& last = p.pose.last_number[static_cast<std::size_t>(pair)];
    last = std::max(last, number);
  }
  ResultTable table() const { return pose_table(scene.scene, scene.model, steps, records); }
};

bool empty(const ResultTable& t, std::size_t row, const std::string& column) {
  return std::holds_alternative<std::monostate>(t.at(row, t.column_index(column)));
}

TEST(PoseTable, SeveralContactsAreNumberedAndKeepTheirNumbers) {
  Bench bench;
  bench.close(bench.add(1, 0, 0), 0, 1, {-0.01, 0, 0}, 30);
  PosePoint& both = bench.add(1, 0.1, 0);
  bench.close(both, 0, 2, {0.02, 0.01, 0}, 10);  // the order in the state does not matter
  bench.close(both, 0, 1, {-0.01, 0, 0}, 30);
  PosePoint& second = bench.add(1, 0.2, 0);
  bench.close(second, 0, 2, {0.02, 0, 0}, 12);
  second.pose.open.push_back({0, 1, bench.facing({-0.01, 0, 0}, 7e-5), 7e-5});
  bench.close(second, 1, 1, {0, 0, 0}, 5);
  const ResultTable t = bench.table();
  EXPECT_TRUE(t.has_column("foot.1.force_N") && t.has_column("foot.2.floor.x_mm"));
  EXPECT_FALSE(t.has_column("foot.3.force_N"));
  EXPECT_FALSE(t.has_column("toe.1.force_N"));  // never more than one
  EXPECT_EQ(t.number(0, "foot.1.force_N"), 30);
  EXPECT_TRUE(empty(t, 0, "foot.2.force_N"));
  EXPECT_EQ(t.number(1, "foot.1.force_N"), 30);
  EXPECT_EQ(t.number(1, "foot.2.force_N"), 10);
  EXPECT_NEAR(t.number(1, "foot.2.gap_mm"), 3e-3, 1e-12);
  EXPECT_NEAR(t.number(1, "foot.2.ball.x_mm"), 10, 1e-12);  // the bone is turned by 90 deg about z
  EXPECT_NEAR(t.number(1, "foot.2.ball.y_mm"), -20, 1e-12);
  EXPECT_EQ(t.number(1, "foot.force_N"), 40);
  EXPECT_NEAR(t.number(1, "foot.floor.x_mm"), (-10 * 30 + 20 * 10) / 40.0, 1e-12);
  EXPECT_EQ(t.number(2, "foot.1.force_N"), 0);  // open
  EXPECT_NEAR(t.number(2, "foot.1.gap_mm"), 0.07, 1e-12);
  EXPECT_EQ(t.number(2, "foot.2.force_N"), 12);
  EXPECT_EQ(t.number(2, "toe.force_N"), 5);
}

TEST(PoseTable, RegionsSplitForceAndCentre) {
  Bench bench;
  PosePoint& p = bench.add(1, 0, 0);
  bench.close(p, 0, 1, {0.01, 0.002, 0}, 30);
  bench.close(p, 0, 2, {0.03, 0.006, 0}, 10);
  p.pose.open.push_back({0, 3, bench.facing({-0.01, 0, 0}, 5e-5), 5e-5});
  p.pose.last_number[0] = 3;
  const ResultTable t = bench.table();
  EXPECT_EQ(t.number(0, "foot.right.force_N"), 40);
  EXPECT_EQ(t.number(0, "foot.right.points"), 2);
  EXPECT_NEAR(t.number(0, "foot.right.x_mm"), 15, 1e-12);
  EXPECT_NEAR(t.number(0, "foot.right.y_mm"), 3, 1e-12);
  EXPECT_EQ(t.number(0, "foot.left.force_N"), 0);  // an open contact is no point of support
  EXPECT_EQ(t.number(0, "foot.left.points"), 0);
  EXPECT_TRUE(empty(t, 0, "foot.left.x_mm"));
}

TEST(PoseTable, AnOpenPairShowsItsGapAndNearestPoints) {
  Bench bench;
  PosePoint& p = bench.add(1, 0, 0);
  p.pose.open.push_back({0, 1, bench.facing({0.004, 0, 0}, 9e-5), 9e-5});
  p.pose.open.push_back({0, 2, bench.facing({-0.006, 0, 0}, 5e-5), 5e-5});
  bench.records[0].pair_gap = {5e-5, INFINITY};
  const ResultTable t = bench.table();
  EXPECT_EQ(t.number(0, "foot.force_N"), 0);
  EXPECT_NEAR(t.number(0, "foot.gap_mm"), 0.05, 1e-14);
  EXPECT_NEAR(t.number(0, "foot.floor.x_mm"), -6, 1e-12);
  EXPECT_EQ(t.number(0, "toe.force_N"), 0);
  EXPECT_TRUE(empty(t, 0, "toe.gap_mm"));
  EXPECT_TRUE(empty(t, 0, "toe.floor.x_mm"));
}

TEST(PoseTable, ReactionsAreInNewtonMetresAndNewtons) {
  Bench bench;
  bench.add(1, 0.5, 2.5);
  bench.add(2, 1e-3, -7);
  const ResultTable t = bench.table();
  EXPECT_EQ(t.number(0, "j.a.reaction_Nm"), 2.5);
  EXPECT_TRUE(empty(t, 0, "j.x.reaction_N"));
  EXPECT_EQ(t.number(1, "j.x.reaction_N"), -7);
  EXPECT_TRUE(empty(t, 1, "j.a.reaction_Nm"));
  EXPECT_FALSE(t.has_column("j.b.reaction_Nm"));
  EXPECT_NEAR(t.number(0, "j.z_mm"), 20, 1e-12);
}

TEST(PoseTable, ASpringWithoutSlackLengthHasNoStrain) {
  Bench bench;
  bench.add(1, 0, 0);
  const ResultTable t = bench.table();
  EXPECT_TRUE(empty(t, 0, "cord.strain"));
  EXPECT_NEAR(t.number(0, "cord.length_mm"), 20, 1e-12);
  EXPECT_NEAR(t.number(0, "cord.force_N"), 20, 1e-12);
  EXPECT_NEAR(t.number(0, "rope.strain"), 0.25, 1e-12);  // 25 mm long, 20 mm slack
  EXPECT_NEAR(t.number(0, "rope.force_N"), 10, 1e-12);
}

TEST(PoseTable, JointsShowWhatTheyLeaveAndWhatHoldsTheRest) {
  const test::SceneModel s = test::scene_model(test::bone_on_ground() + R"([body.tool]
[joint.hinge]
type = "revolute"
parent = "bone"
child = "tool"
axis = [0, 0, 1]
origin = [10, 0, 0]
[combination.mix]
terms = { "j.c" = 1, "hinge.angle" = -3 }
)");
  StepPlan plan;
  const QuantityRef mix{{0, 2}, 0};
  plan.prescribed = {{mix, 0, 1}};
  PoseRecord r;
  r.point.report.status = PoseStatus::ok;
  r.point.target.prescribed = {{mix, 0.1}};
  r.point.pose.state = reference_state(s.model);
  r.point.pose.state.coordinates[0][2] = 0.4;
  r.point.pose.state.coordinates[1][0] = 0.1;
  r.point.pose.state.multipliers = {7, 0, 0, 1, 2, 3};
  const ResultTable t = pose_table(s.scene, s.model, {plan}, {r});
  EXPECT_NEAR(t.number(0, "hinge.angle_deg"), 0.1 / kDegree, 1e-13);
  EXPECT_NEAR(t.number(0, "mix_deg"), 0.1 / kDegree, 1e-13);
  EXPECT_EQ(t.number(0, "mix.reaction_Nm"), 7);
  EXPECT_NEAR(t.number(0, "hinge.reaction.force_x_N"), 1, 1e-15);
  EXPECT_NEAR(t.number(0, "hinge.reaction.force_y_N"), 2, 1e-15);
  EXPECT_NEAR(t.number(0, "hinge.reaction.force_z_N"), 3, 1e-15);
  EXPECT_EQ(t.number(0, "hinge.reaction.moment_x_Nm"), 0);
  EXPECT_FALSE(t.has_column("hinge._deg"));
  EXPECT_FALSE(t.has_column("hinge._mm"));
  EXPECT_FALSE(t.has_column("j.reaction.force_x_N"));
}

TEST(PoseTable, TheClinicalDescriptionStandsBesideTheJointsOwn) {
  Bench bench;
  GroodSuntayDef def;
  def.femur.body = 1;
  def.tibia.body = 0;
  def.femur.origin = Vec3(0, 0, -0.005);
  bench.scene.scene.joints[0].grood_suntay = def;
  bench.bone = {exp_rotation(0.25 * Vec3::UnitX()), Vec3(0.001, 0.002, 0.02)};
  bench.add(1, 0, 0);
  const ResultTable t = bench.table();
  EXPECT_NEAR(t.number(0, "j.gs.flexion_deg"), 0.25 / kDegree, 1e-12);
  EXPECT_NEAR(t.number(0, "j.gs.adduction_deg"), 0, 1e-12);
  EXPECT_NEAR(t.number(0, "j.gs.external_rotation_deg"), 0, 1e-12);
  EXPECT_NEAR(t.number(0, "j.gs.lateral_mm"), -1, 1e-12);
  EXPECT_NEAR(t.number(0, "j.gs.anterior_mm"), -2 - 5 * std::sin(0.25), 1e-12);
  EXPECT_NEAR(t.number(0, "j.gs.distraction_mm"), 20 - 5 * std::cos(0.25), 1e-12);
}

TEST(PoseTable, ContactPointsAreFromTheOriginsOfTheFile) {
  Bench bench;
  bench.close(bench.add(1, 0, 0), 0, 1, {-0.01, 0, 0}, 30);
  const ResultTable here = bench.table();
  bench.scene.model.bodies[0].centre = Vec3(1, 2, 3);
  bench.scene.model.bodies[1].centre = Vec3(-4, 5, 6);
  const ResultTable there = bench.table();
  const auto moved = [&](const char* column) { return there.number(0, column) - here.number(0, column); };
  EXPECT_NEAR(moved("foot.floor.x_mm"), 1000, 1e-9);
  EXPECT_NEAR(moved("foot.ball.y_mm"), 5000, 1e-9);
  EXPECT_NEAR(moved("foot.left.z_mm"), 3000, 1e-9);
  EXPECT_EQ(moved("foot.left.force_N"), 0);
}

TEST(PoseTable, AFailedPoseHasItsPrescribedCoordinatesAndNothingElse) {
  Bench bench;
  bench.add(1, 0, 1);
  bench.records.emplace_back();
  PosePoint& failed = bench.records.back().point;
  failed.step = 1;
  failed.increment = 2;
  failed.report.status = PoseStatus::no_equilibrium;
  failed.target.prescribed = {{{0, 0}, 30 * kDegree}};
  failed.target.time = 1.5;
  const ResultTable t = bench.table();
  EXPECT_EQ(std::get<std::string>(t.at(1, t.column_index("status"))), to_string(PoseStatus::no_equilibrium));
  EXPECT_NEAR(t.number(1, "j.a_deg"), 30, 1e-13);
  EXPECT_EQ(t.number(1, "time_s"), 1.5);
  for (const std::string& column : t.columns()) {
    const bool known =
        column == "step" || column == "increment" || column == "time_s" || column == "status" || column == "branch";
    if (known || column == "j.a_deg") continue;
    EXPECT_TRUE(empty(t, 1, column)) << column;
  }
}

TEST(PoseTable, ALoadThatAStepChangesShowsItsFactor) {
  Bench bench;
  EXPECT_FALSE(bench.table().has_column("lift.factor")) << "no step changes it";
  for (StepPlan& step : bench.steps) step.factors = {{1, 1}};
  bench.steps[1].factors = {{0, 1}};
  bench.add(1, 0, 1).target.load_factors = {1};
  bench.add(2, 0, 1).target.load_factors = {-0.25};
  PoseRecord failed;
  failed.point.target.load_factors = {0.5};
  bench.records.push_back(failed);
  const ResultTable t = bench.table();
  EXPECT_EQ(t.number(0, "lift.factor"), 1);
  EXPECT_EQ(t.number(1, "lift.factor"), -0.25);
  EXPECT_EQ(t.number(2, "lift.factor"), 0.5);
}

TEST(PoseTable, AScaledLoadShowsItsScale) {
  Bench bench;
  ScaleDef def;
  def.table = {{1, 3}, {2, 5}};
  std::string why;
  bench.scene.model.loads[0].scale = LoadScale::make(def, why);
  bench.add(1, 0, 1).target.time = 1.25;
  bench.add(1, 0, 1).target.time = 9;
  def.kind = ScaleDef::Kind::over_coordinate;
  def.coordinate = {0, 5};
  def.table = {{0.01, 0}, {0.03, 1}};  // the bone's z is 20 mm
  EXPECT_NEAR(bench.table().number(0, "lift.scale"), 3.5, 1e-14);
  EXPECT_EQ(bench.table().number(1, "lift.scale"), 5);
  EXPECT_EQ(bench.table().number(1, "time_s"), 9);
  bench.scene.model.loads[0].scale = LoadScale::make(def, why);
  EXPECT_NEAR(bench.table().number(0, "lift.scale"), 0.5, 1e-14);
}

TEST(EventTable, SaysWhereInTheUnitsOfTheResults) {
  const Bench bench;
  PathEvent gained{PathEvent::Kind::contact_gained, 1, 0.25, {{{{0, 0}, 15 * kDegree}}, {1}, 0.75}, "foot.2"};
  PathEvent lost{PathEvent::Kind::contact_lost, 2, 0.5, {{{{0, 3}, 2e-3}}, {0.5}, 3}, "foot.1"};
  lost.coordinates = {{0, 0, 30 * kDegree, 1, 0, 4e-3}};
  const ResultTable t = event_table(bench.scene.scene, bench.steps, {gained, lost});
  EXPECT_EQ(t.columns(), (std::vector<std::string>{"step", "t", "time_s", "event", "what", "j.a_deg", "j.b_deg",
                                                   "j.c_deg", "j.x_mm", "j.y_mm", "j.z_mm", "lift.factor"}));
  ASSERT_EQ(t.rows(), 2u);
  EXPECT_NEAR(t.number(0, "j.a_deg"), 15, 1e-13);
  EXPECT_TRUE(empty(t, 0, "j.x_mm"));
  EXPECT_EQ(t.number(0, "t"), 0.25);
  EXPECT_EQ(t.number(0, "time_s"), 0.75);
  EXPECT_EQ(std::get<std::string>(t.at(0, 3)), to_string(PathEvent::Kind::contact_gained));
  EXPECT_EQ(std::get<std::string>(t.at(0, 4)), "foot.2");
  EXPECT_NEAR(t.number(1, "j.x_mm"), 2, 1e-14) << "what is prescribed is shown as prescribed";
  EXPECT_NEAR(t.number(1, "j.c_deg"), 30, 1e-13);
  EXPECT_NEAR(t.number(1, "j.z_mm"), 4, 1e-14);
  EXPECT_TRUE(empty(t, 0, "j.z_mm"));
  EXPECT_EQ(t.number(1, "lift.factor"), 0.5);
}

}  // namespace
}  // namespace genu
