#include "genu/appraise/verdict.h"

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/scenes.h"

namespace genu {
namespace {

/// A scene with one coordinate prescribed at 41.2 deg, and what is said of it.
class Verdict : public testing::Test {
 protected:
  void SetUp() override {
    Diagnostics out;
    prepared.scene = place(*read_scene(test::dortmans_file(), out));
    prepared.steps = plan_steps(prepared.scene);
    target.prescribed.push_back({{0, 0}, 41.2 * M_PI / 180});
    summary.poses_asked = 3;
    summary.poses_solved = summary.poses_stable = 2;
    summary.exit_code = 3;
  }
  std::string said() const {
    std::string text;
    for (const std::string& sentence : verdict_sentences(prepared, records, events, summary)) text += sentence + "\n";
    return text;
  }
  void expect_said(const std::string& piece) const { EXPECT_NE(said().find(piece), std::string::npos) << said(); }

  Prepared prepared;
  Target target;
  std::vector<PoseRecord> records;
  std::vector<PathEvent> events;
  RunSummary summary;
};

TEST_F(Verdict, AllWell) {
  summary.poses_solved = 3;
  summary.exit_code = 0;
  EXPECT_EQ(said(),
            "Every pose is solved and certified; 2 of 3 stable, the others unstable (see column `stability`).\n");
}

TEST_F(Verdict, OtherPosesAreCalledUnstableOnlyIfAllOfThemAre) {
  summary.poses_solved = 3;
  summary.exit_code = 0;
  records.resize(3);
  records[2].point.stability.verdict = Stability::Verdict::neutral;
  expect_said("2 of 3 stable (see column `stability`).");
}

TEST_F(Verdict, ManyChangesOfStabilityAreCounted) {
  for (int k = 0; k < 40; ++k) {
    PathEvent e;
    e.kind = PathEvent::Kind::stability_changed;
    e.step = 1;
    e.target = target;
    e.what = "neutral";
    events.push_back(e);
  }
  expect_said("28 more changes of stability are in events.csv.");
  EXPECT_LT(said().size(), 2000U);
}

TEST_F(Verdict, EveryFailureSaysWhichWhereAndWhatToDo) {
  for (const PoseStatus status : {PoseStatus::no_equilibrium, PoseStatus::over_edge, PoseStatus::overlap,
                                  PoseStatus::chatter, PoseStatus::overconstrained, PoseStatus::undetermined}) {
    PoseRecord record;
    record.point.step = 1;
    record.point.target = target;
    record.point.report.status = status;
    record.point.report.why = "reason";
    records = {record};
    expect_said(std::string(to_string(status)) + " at knee.flexion = 41.2 deg: reason. ");
    EXPECT_GT(said().size() - said().find("reason. "), 20u) << "no advice: " << said();
    expect_said("2 of 3 poses are solved");
  }
}

TEST_F(Verdict, EventsAreTold) {
  using Kind = PathEvent::Kind;
  Target later = target;
  later.prescribed[0].value = 0.75;
  events = {{Kind::stepped_over, 1, 0.1, target, ""},
            {Kind::stepped_over, 1, 0.2, later, ""},
            {Kind::turns_back, 1, 0.3, target, ""},
            {Kind::stability_changed, 1, 0.4, target, "unstable"},
            {Kind::held, 1, 0.45, target, "AAC at 24 mm, 16 N below and 20 N above"},
            {Kind::jump, 1, 0.45, later, "PCL at 30 mm, 9 N below and 7 N above"},
            {Kind::over_edge, 1, 0.5, target, "medial.1"},
            {Kind::limit_point, 1, 0.6, target, "unstable", {{0, 0.1, 0, 0, 0, 2e-3}}},
            {Kind::bifurcation, 1, 0.6, target, "unstable"},
            {Kind::reaction_turns, 1, 0.7, target, "largest 0.570123456 Nm"},
            {Kind::reaction_turns, 1, 0.8, later, "smallest -0.2 Nm"},
            {Kind::closed, 1, 0.9, target, ""}};
  expect_said("from knee.flexion = 41.2 deg to knee.flexion = 42.97 deg");
  expect_said("turns back at knee.flexion = 41.2 deg");
  expect_said("becomes unstable at knee.flexion = 41.2 deg");
  expect_said("From knee.flexion = 41.2 deg on a ligament stays at the jump of its law");
  expect_said("AAC at 24 mm, 16 N below and 20 N above.");
  expect_said("At knee.flexion = 42.97 deg the force of a ligament drops");
  expect_said("medial.1 reaches the edge");
  expect_said("Limit point at knee.flexion = 41.2 deg (knee.adduction 5.73 deg, knee.rotation 0 deg,");
  expect_said("the path turns back and is unstable from here on");
  expect_said("knee.z 2 mm)");
  expect_said("Bifurcation at knee.flexion = 41.2 deg: ");
  expect_said("has a local maximum of 0.5701 Nm at knee.flexion = 41.2 deg");
  expect_said("See events.csv for 1 more.");
  expect_said("The path is closed");
}

TEST_F(Verdict, OverloadedLayersAreNoMatterOfWhereToStart) {
  PoseRecord record;
  record.point.step = 1;
  record.point.target = target;
  record.point.report.status = PoseStatus::no_equilibrium;
  records = {record};
  expect_said("Start nearer to equilibrium");
  summary.bearable_loads = 0.1;
  EXPECT_EQ(said().find("Start nearer"), std::string::npos) << said();
  expect_said("The joint balances here under 0.1 of its loads at the start");
  summary.bearable_loads = 0;
  records.insert(records.begin(), PoseRecord{});
  records[0].point.report.status = PoseStatus::ok;
  expect_said("Follow the step with `control = \"arc_length\"`");
  prepared.scene.layers.emplace_back();
  expect_said("Follow the step with `control = \"arc_length\"`");
  prepared.steps[0].factors = {{0.5, 1}};
  expect_said("The layers may not carry this load");
  prepared.steps[0].factors = {{1, 0.5}};
  expect_said("Follow the step with `control = \"arc_length\"`");
}

}  // namespace
}  // namespace genu
