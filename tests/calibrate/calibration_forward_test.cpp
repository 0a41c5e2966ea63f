// Standard errors of results: the linear ones agree with drawn ones.
#include "genu/calibrate/calibration_forward.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "genu/assemble/with_numbers.h"
#include "genu/calibrate/calibrate.h"
#include "genu/study/solve_path.h"
#include "support/csv_table.h"
#include "support/scenes.h"
#include "support/text.h"
#include "support/wheel_knee.h"

namespace genu {
namespace {

TEST(CalibrationForward, LinearAndDrawnErrorsAgree) {
  const test::TemporaryFolder folder;
  const ResultTable truth = test::table_of(test::wheel_knee());
  std::string csv = "knee.flexion_deg,knee.x_mm,knee.rotation_deg\n";
  for (std::size_t row = 0; row < truth.rows(); ++row)
    csv += fmt::format("{:.17g},{:.17g},{:.17g}\n", truth.number(row, "knee.flexion_deg"),
                       truth.number(row, "knee.x_mm"), truth.number(row, "knee.rotation_deg"));
  CalibrationChoice choice;
  choice.targets = {folder.write("target.csv", csv)};
  choice.errors = {"knee.x_mm=0.02", "knee.rotation_deg=0.05"};
  choice.vary = {"ahead.slack_length", "behind.slack_length"};
  choice.priors = {"*.slack_length=start~0.1%"};
  CalibrationResult result;
  Diagnostics out;
  ASSERT_EQ(run_calibration(folder.write("knee.toml", test::wheel_knee()), folder / "out", choice, {}, out, result),
            kExitOk)
      << test::messages(out) << to_text(result.report);
  const ResultTable errors = test::read_table(folder / "out/standard_errors.csv");
  ASSERT_EQ(errors.rows(), truth.rows());
  for (const char* column : {"step", "increment"})
    for (std::size_t row = 0; row < truth.rows(); ++row)
      EXPECT_EQ(errors.number(row, column), truth.number(row, column));

  const auto& p = result.report.parameters;
  const double r = result.report.correlation(0, 1);
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 1);
  constexpr int kDraws = 100;
  constexpr std::size_t kRow = 0;  // where all springs are well taut
  const std::vector<std::string> columns = {"knee.x_mm", "ahead.force_N", "behind.strain", "medial.force_N"};
  std::vector<double> sum(columns.size()), square(columns.size());
  for (int draw = 0; draw < kDraws; ++draw) {
    const double a = normal(random), b = normal(random);
    std::array<double, 5> lengths = {25, 20, 19.2, 24, 24};
    lengths[0] *= std::exp(p[0].deviation / p[0].value * a);
    lengths[4] *= std::exp(p[1].deviation / p[1].value * (r * a + std::sqrt(1 - r * r) * b));
    Diagnostics said;
    const auto knee = prepare({folder.write("drawn.toml", test::wheel_knee(lengths)), {}}, said);
    ASSERT_TRUE(knee) << test::messages(said);
    ContactField field = contact_field(*knee);
    const ResultTable drawn = pose_table(knee->scene, knee->model, knee->steps, solve_path(*knee, field, {}).records);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = drawn.number(kRow, columns[c]);
      sum[c] += value;
      square[c] += value * value;
    }
  }
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const double sd = std::sqrt(square[c] / kDraws - sum[c] * sum[c] / (kDraws * kDraws));
    std::printf("%s: linear %.4g, drawn %.4g\n", columns[c].c_str(), errors.number(kRow, columns[c]), sd);
    EXPECT_GT(sd, 0);
    EXPECT_NEAR(errors.number(kRow, columns[c]) / sd, 1, 0.25) << columns[c];  // 100 draws: 7 % in one of three
  }
  const std::string study = test::read_file(folder / "out/study.toml");
  for (const char* part : {"scene = \"scene.toml\"", "\"ahead.slack_length\" = { lognormal = ", "relative = true",
                           "factors = [\"ahead.slack_length\", \"behind.slack_length\"]", "\"medial.force_N\""})
    EXPECT_TRUE(test::contains(study, part)) << part << "\n" << study;
}

}  // namespace
}  // namespace genu
