// The choice among made-up errors and times.
#include "genu/study/accuracy_choice.h"

#include <limits>

#include <gtest/gtest.h>

namespace genu {
namespace {

using Knob = AccuracySetting::Knob;

struct Made {
  AccuracySetting setting;
  double error, microseconds;
  bool complete = true;
};

/// One group, position in mm.
AccuracyReport report_of(const std::vector<Made>& made, double target) {
  AccuracyReport report;
  report.groups.push_back({"position", "mm", {"knee.x_mm"}, 0, 0, 0});
  if (target > 0) report.targets["mm"] = target;
  for (const Made& m : made) {
    AccuracyPoint p;
    p.setting = m.setting;
    p.name = "setting " + std::to_string(report.points.size());
    p.errors = {m.error};
    p.solved = m.complete ? 9 : 8;
    p.asked = 9;
    p.pose_seconds = 1e-6 * m.microseconds;
    report.points.push_back(p);
  }
  return report;
}

AccuracySetting mesh(double edge, int degree = 3, double tolerance = 0) {
  return {.knob = tolerance > 0 ? Knob::tolerance : Knob::mesh,
          .edge_factor = edge,
          .degree = degree,
          .tolerance = tolerance};
}

AccuracySetting tolerance(double value) { return {.knob = Knob::tolerance, .tolerance = value}; }

TEST(AccuracyChoice, TakesTheToleranceThatSavesTimeAndTheFinestOfThose) {
  const auto knee = [&](double plain, double at_8, double at_5, double at_3) {
    return report_of({{{}, 1e-4, 100},
                      {mesh(2), 5e-3, plain},
                      {mesh(2, 3, 1e-8), 5e-3, at_8},
                      {mesh(2, 3, 1e-5), 5e-3, at_5},
                      {mesh(2, 3, 1e-3), 2e-2, at_3}},
                     0.01);
  };
  const auto chosen = [](AccuracyReport report) {
    choose(report, false, 1e-12);
    return report.chosen;
  };
  EXPECT_EQ(chosen(knee(50, 30, 29, 10)), 2) << "1e-5 saves next to nothing more, 1e-3 misses the target";
  EXPECT_EQ(chosen(knee(50, 40, 29, 10)), 3);
  EXPECT_EQ(chosen(knee(50, 49, 47, 10)), 1) << "nothing that could be told from noise is saved";
  AccuracyReport lost = knee(50, 30, 29, 10);
  lost.points[2].solved = 8;
  EXPECT_EQ(chosen(lost), 3) << "a tolerance that loses a pose is none";
}

TEST(AccuracyChoice, NamesTheToleranceItHas) {
  AccuracyReport report = report_of({{{}, 1e-4, 100}, {mesh(2), 5e-3, 50}}, 0.01);
  choose(report, false, 1e-10);
  EXPECT_EQ(report.sentence, "0.005 mm (position) cost 50 us a pose: setting 1, tolerance 1e-10.");
  report = report_of({{{}, 1e-4, 100}, {mesh(2), 5e-3, 50}, {mesh(2, 3, 1e-8), 5e-3, 20}}, 0.01);
  choose(report, false, 1e-10);
  EXPECT_EQ(report.sentence, "0.005 mm (position) cost 20 us a pose: setting 2.");
}

TEST(AccuracyChoice, AToleranceOfAnotherMeshIsNotOfThisOne) {
  AccuracyReport report =
      report_of({{{}, 1e-4, 100}, {mesh(2), 5e-3, 50}, {mesh(3), 2e-2, 40}, {mesh(3, 3, 1e-5), 5e-3, 10}}, 0.01);
  choose(report, false, 1e-12);
  EXPECT_EQ(report.chosen, 1);
}

/// The finest meshes may take too long: that says nothing against coarser ones.
TEST(AccuracyChoice, AFinerMeshThatWasCalledOffIsNoReasonAgainstThisOne) {
  AccuracyReport report = report_of({{{}, 0, 10}, {mesh(1), 1e-3, 900, false}, {mesh(2), 5e-3, 50}}, 0.01);
  choose(report, true, 1e-12);
  EXPECT_EQ(report.chosen, -1) << "the finer one is lost: the coarser one may be so by chance";
  report.points[1].called_off = true;
  choose(report, true, 1e-12);
  EXPECT_EQ(report.chosen, 2);
  report.points[1].errors = {std::numeric_limits<double>::quiet_NaN()};
  choose(report, true, 1e-12);
  EXPECT_EQ(report.chosen, 2) << "called off before its first pose";
  report.points[1].errors = {0.02};
  choose(report, true, 1e-12);
  EXPECT_EQ(report.chosen, -1) << "what it had solved by then is off by too much";
}

TEST(AccuracyChoice, OfClosedFormsWithATargetAMeshIsTaken) {
  const std::vector<Made> made = {{{}, 0, 10}, {mesh(1), 1e-3, 50}, {tolerance(1e-8), 1e-7, 5}};
  AccuracyReport with = report_of(made, 0.01), without = report_of(made, 0);
  choose(with, true, 1e-12);
  EXPECT_EQ(with.chosen, 1);
  choose(without, true, 1e-12);
  EXPECT_EQ(without.chosen, 2) << "an error of 1e-7 mm is none";
  AccuracyReport unmeshed = report_of({{{}, 0, 10}, {tolerance(1e-8), 1e-7, 9.5}}, 0.01);
  choose(unmeshed, true, 1e-12);
  EXPECT_EQ(unmeshed.chosen, 0) << "no mesh was tried: what is exact keeps the target";
}

TEST(AccuracyChoice, AToleranceMendsASceneWhoseOwnIsTooCoarse) {
  AccuracyReport report = report_of({{{}, 1, 10, false}, {mesh(2), 1, 50, false}, {tolerance(1e-12), 0, 60}}, 0);
  choose(report, false, 1e-3);
  EXPECT_EQ(report.chosen, 2);
  report = report_of({{{}, 1, 10, false}}, 0);
  choose(report, false, 1e-3);
  EXPECT_EQ(report.chosen, -1);
  EXPECT_NE(report.sentence.find("nothing to choose from"), std::string::npos);
  EXPECT_TRUE(tolerances_to_try(report).empty());
}

TEST(AccuracyChoice, TriesTheTolerancesThatSolveTheSceneOnTheChosenMesh) {
  AccuracyReport report = report_of({{{}, 1e-4, 100},
                                     {mesh(2), 5e-3, 50},
                                     {tolerance(1e-3), 1, 90, false},
                                     {tolerance(1e-5), 1e-4, 90},
                                     {tolerance(1e-8), 1e-4, 90}},
                                    0.01);
  choose(report, false, 1e-12);
  ASSERT_EQ(report.chosen, 1);
  EXPECT_EQ(tolerances_to_try(report), (std::vector<AccuracySetting>{mesh(2, 3, 1e-5), mesh(2, 3, 1e-8)}));
  report.chosen = 0;
  EXPECT_TRUE(tolerances_to_try(report).empty()) << "those of the scene as it is are among the settings";
}

}  // namespace
}  // namespace genu
