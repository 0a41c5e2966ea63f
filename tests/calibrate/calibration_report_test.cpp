// Standard errors of bundles' lengths of the measured knee: how often the truth lies within two of them.
#include "genu/calibrate/calibration_report.h"

#include <cmath>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "genu/assemble/prepare.h"
#include "genu/calibrate/laxity_experiment.h"
#include "genu/core/units.h"
#include "support/data.h"
#include "support/scenes.h"

namespace genu {
namespace {

constexpr double kMillimetres = 0.3, kDegrees = 0.5;  // of noise
constexpr std::pair<LaxityTest::Kind, double> kFullLoads[] = {
    {LaxityTest::Kind::drawer, 134}, {LaxityTest::Kind::varus, 10}, {LaxityTest::Kind::rotation, 5}};
constexpr int kReadings = 4;  // of each load: measured again, not computed again

/// Nine bundles, full and half loads at each angle, from the true lengths on: only the noise moves the fit. The tenth,
/// the posterior capsule, is hardly stretched by these loads: with noise it is slack in many draws, and stays as it is
/// here.
TEST(CalibrationReport, TheTrueLengthsOfTheMeasuredKneeLieWithinTwoStandardErrors) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  const bool whole = std::getenv("GENU_LONG") != nullptr;
  const int draws = whole ? 200 : 2;
  const std::vector<double> angles = {0, 60 * units::kDegree};
  Diagnostics out;
  test::TemporaryFolder folder;
  std::string text = test::read_file(test::source_folder() + "/meshes/lenhart2015/scene-cartilage.toml");
  for (std::size_t k; (k = text.find("../../../shared/data/")) != std::string::npos;)
    text.replace(k, 21, test::data_path(""));
  auto prepared = prepare(folder.write("knee.toml", text), out);
  ASSERT_TRUE(prepared) << test::messages(out);
  UnknownChoice choice;
  for (const char* name : {"ACLam", "ACLpl", "LCL", "MCLd", "MCLp", "MCLs", "PCLal", "PCLpm", "PFL"})
    choice.vary.push_back(std::string(name) + "*.slack_length:together");
  const auto unknowns = choose_unknowns(prepared->source, choice, out);
  auto knee = with_laxity_loads(*prepared, out);
  ASSERT_TRUE(knee && unknowns.size() == 9) << test::messages(out);
  share_search(knee->prepared);
  LaxityTarget target;
  for (const double angle : angles)
    for (const auto& [kind, load] : kFullLoads)
      for (const double part : {1.0, 0.5, -0.5, -1.0})
        for (int reading = 0; reading < kReadings; ++reading)
          target.add(angle, kind, part * load,
                     kind == LaxityTest::Kind::drawer ? "displacement_mm" : "displacement_deg", 0);
  target.arrange();
  const VecX truth = VecX::Zero(static_cast<Eigen::Index>(unknowns.size()));
  const CalibrationPrediction clean = laxity_experiment(*knee, unknowns, target, 0, {})->predict(truth, true);
  ASSERT_GT(clean.derivatives.size(), 0) << clean.failed;

  std::mt19937 random(20);
  std::normal_distribution<double> noise(0, 1);
  std::vector<int> within(unknowns.size(), 0), known(unknowns.size(), 0);
  int ended_well = 0, runs = 0;
  for (int draw = 0; draw < draws; ++draw) {
    LaxityTarget noisy = target;
    for (std::size_t k = 0; k < noisy.values.size(); ++k) {
      const double error = target.columns[noisy.values[k].column] == "displacement_mm" ? kMillimetres : kDegrees;
      noisy.values[k].value = clean.values[static_cast<Eigen::Index>(k)] + error * noise(random);
    }
    std::vector<std::unique_ptr<CalibrationExperiment>> experiments;
    experiments.push_back(laxity_experiment(*knee, unknowns, noisy, 0, {}));
    experiments[0]->state_errors({{"displacement_mm", kMillimetres}, {"displacement_deg", kDegrees}});
    const CalibrationProblem problem(unknowns, experiments, 1e-4);
    SolvableStart start;
    const VecX scales = experiments[0]->scales();
    start.at.u = truth;
    start.at.predictions = {clean};
    start.at.residuals = (clean.values - experiments[0]->wanted()).cwiseQuotient(scales);
    start.at.derivatives = scales.cwiseInverse().asDiagonal() * clean.derivatives;
    const CalibrationSearch found = search(problem, {}, start);
    const CalibrationReport report = find_out(problem, found).report;
    runs += problem.runs();
    ended_well += report.converged ? 1 : 0;
    if (!report.converged) {
      std::printf("draw %d: %s\n", draw, report.stop.c_str());
      continue;
    }
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const CalibrationReport::Parameter& p = report.parameters[k];
      if (!std::isfinite(p.deviation)) continue;
      ++known[k];
      within[k] += std::abs(p.value - 1) < 2 * p.deviation ? 1 : 0;
    }
  }
  std::printf("%d of %d fits converged, %d runs\n", ended_well, draws, runs);
  int all = 0, most = 0;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    std::printf("%-34s %d of %d\n", unknowns[k].name.c_str(), within[k], known[k]);
    all += within[k], most += known[k];
  }
  EXPECT_GE(all, 0.9 * most);
  EXPECT_GE(ended_well, 0.9 * draws);
  if (whole) {
    EXPECT_LE(all, 0.98 * most);
  }
}

}  // namespace
}  // namespace genu
