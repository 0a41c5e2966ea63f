#include "genu/results/curves.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

PlacedScene knee() {
  PlacedScene scene;
  scene.title = "knee";
  scene.bodies.resize(2);
  scene.bodies[0].name = "tibia";
  scene.bodies[0].fixed = true;
  scene.bodies[1].name = "femur";
  JointDef joint;
  joint.name = "knee";
  joint.rotations[0].name = "flexion";
  joint.rotations[1].name = "adduction";
  joint.rotations[2].name = "rotation";
  joint.translations = {"x", "y", "z"};
  scene.joints.push_back(joint);
  for (const char* name : {"ACL1", "ACL2", "PCL", "7"}) {
    LigamentDef l;
    l.name = name;
    scene.ligaments.push_back(l);
  }
  return scene;
}

std::vector<StepPlan> flexion(std::size_t steps) {
  StepPlan plan;
  plan.prescribed.push_back({{0, 0}, 0, 1});
  plan.increments = 2;
  return std::vector<StepPlan>(steps, plan);
}

ResultTable table(const std::vector<double>& angles) {
  ResultTable poses;
  for (const char* name :
       {"knee.flexion_deg", "knee.adduction_deg", "ACL1.force_N", "ACL2.force_N", "PCL.force_N", "7.force_N"})
    poses.add_column(name);
  for (const double angle : angles) {
    poses.add_row();
    poses.set("knee.flexion_deg", angle);
    poses.set("ACL1.force_N", 10.0);
    poses.set("ACL2.force_N", 5.0);
    poses.set("PCL.force_N", 20.0);
    poses.set("7.force_N", 1.0);
  }
  return poses;
}

const ChartPanel& panel(const Chart& chart, const std::string& title) {
  for (const ChartPanel& p : chart.panels)
    if (p.title == title) return p;
  ADD_FAILURE() << "no panel " << title;
  return chart.panels.at(0);
}

TEST(Curves, RunOverThePrescribedCoordinateAndLeaveItOut) {
  PathEvent event;
  event.kind = PathEvent::Kind::contact_gained;
  event.step = 1;
  event.target.prescribed.push_back({{0, 0}, 0.5});
  event.what = "medial.2";
  const Chart chart = curves(knee(), flexion(1), table({0, 30, 60}), {event});
  EXPECT_EQ(chart.x_title, "knee.flexion [deg]");
  EXPECT_EQ(chart.x, (std::vector<double>{0, 30, 60}));
  EXPECT_EQ(panel(chart, "Rotations [deg]").series.size(), 2u);
  ASSERT_EQ(chart.events.size(), 1u);
  EXPECT_EQ(chart.events[0].text, "contact gained at 28.65 deg: medial.2");
}

TEST(Curves, ThereAndBackRunsOverTheRows) {
  PathEvent event;
  event.step = 2;
  event.t = 0.75;
  event.rows_before = 4;
  const Chart chart = curves(knee(), flexion(2), table({0, 30, 60, 30, 0}), {event});
  EXPECT_EQ(chart.x, (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(panel(chart, "Rotations [deg]").series.size(), 3u);
  EXPECT_DOUBLE_EQ(chart.events.at(0).from, 4.5);  // row 3 ends step 1, row 5 step 2
}

TEST(Curves, FibresOfALigamentAreAddedUpAndTheStrongestComeFirst) {
  const Chart chart = curves(knee(), flexion(1), table({0, 30, 60}), {});
  const auto& ligaments = panel(chart, "Ligament force [N]").series;
  ASSERT_EQ(ligaments.size(), 3u);
  EXPECT_EQ(ligaments[0].name, "PCL");
  EXPECT_EQ(ligaments[1].name, "ACL");
  EXPECT_DOUBLE_EQ(ligaments[1].y[0], 15);
  EXPECT_EQ(ligaments[2].name, "7");
  // Sums are no column of results.csv.
  EXPECT_EQ(ligaments[0].column, "PCL.force_N");
  EXPECT_EQ(ligaments[1].column, "");
  EXPECT_EQ(panel(chart, "Rotations [deg]").series[0].column, "knee.adduction_deg");
}

TEST(Curves, TwoEndsOfAWindowAreOneBand) {
  PathEvent from, to;
  from.kind = to.kind = PathEvent::Kind::stepped_over;
  from.target.prescribed.push_back({{0, 0}, 0.1});
  to.target.prescribed.push_back({{0, 0}, 0.2});
  const Chart chart = curves(knee(), flexion(1), table({0, 30, 60}), {from, to});
  ASSERT_EQ(chart.events.size(), 1u);
  EXPECT_EQ(chart.events[0].kind, ChartEvent::Kind::window);
  EXPECT_LT(chart.events[0].from, chart.events[0].to);
}

TEST(Curves, RunOverTimeWhereOnlyLoadsInTimeDriveTheJoint) {
  PlacedScene scene = knee();
  scene.loads.resize(1);
  scene.loads[0].scale.emplace();
  ResultTable poses;
  poses.add_column("time_s");
  for (const double time : {0.0, 0.5, 1.5}) {
    poses.add_row();
    poses.set("time_s", time);
  }
  StepPlan plan;
  plan.increments = 2;
  PathEvent event;
  event.kind = PathEvent::Kind::contact_lost;
  event.step = 1;
  event.target.time = 0.75;
  const Chart chart = curves(scene, {plan}, poses, {event});
  EXPECT_EQ(chart.x_title, "time [s]");
  EXPECT_EQ(chart.x, (std::vector<double>{0, 0.5, 1.5}));
  ASSERT_EQ(chart.events.size(), 1u);
  EXPECT_EQ(chart.events[0].from, 0.75);
  EXPECT_NE(chart.events[0].text.find("at 0.75 s"), std::string::npos) << chart.events[0].text;
}

}  // namespace
}  // namespace genu
