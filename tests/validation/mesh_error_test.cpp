// The spread of a sweep whose meshes err, held to the linear error bar of a mesh that errs as a whole and to that of
// `genu run --error-bars`.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "genu/assemble/surface_variants.h"
#include "genu/mesh_care/noise_field.h"
#include "genu/study/run_scene.h"
#include "genu/study/sensitivity.h"
#include "genu/study/solve_path.h"
#include "genu/sweep/solve_sample.h"
#include "genu/sweep/statistics.h"
#include "support/knee_scene.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

#define GENU_NEEDS_LENHART() GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-coarse.stl")

const std::vector<std::string> kColumns = {"knee.adduction_deg", "knee.rotation_deg", "knee.x_mm", "knee.y_mm",
                                           "knee.z_mm"};

Sweep ready_knee_sweep(const test::TemporaryFolder& folder, const std::string& vary, int samples) {
  folder.write("scene.toml", test::lenhart_scene("-coarse", 0, 60, 4));
  std::string columns;
  for (const std::string& column : kColumns) columns += "\"" + column + "\", ";
  const std::string study =
      folder.write("study.toml", "format = 1\nscene = \"scene.toml\"\nsamples = " + std::to_string(samples) +
                                     "\n[vary]\n" + vary + "\n[[keep]]\ncolumns = [" + columns + "]\nat = [30, 60]\n");
  Diagnostics out;
  auto sweep = prepare_sweep(study, out);
  EXPECT_TRUE(sweep) << test::messages(out);
  return sweep ? std::move(*sweep) : Sweep{};
}

/// [kept number][sample]
std::vector<std::vector<double>> solved(const Sweep& sweep) {
  std::vector<std::vector<double>> numbers(sweep.kept.size());
  for (std::uint64_t i = 0; i < sweep.design.samples(); ++i) {
    const auto r = solve_sample(sweep, sweep.cases[0], i, {});
    EXPECT_TRUE(r && r->verdict != "refused" && r->verdict != "not_solved") << (r ? r->reason : "");
    for (std::size_t k = 0; r && k < numbers.size(); ++k) numbers[k].push_back(r->kept[k]);
  }
  return numbers;
}

/// An error that is alike all over the femur moves its surface along its normals: by exact derivatives each sample is
/// the scene's result plus offset times derivative, and the spread is the linear error bar, SD times derivative.
TEST(MeshError, OfALongCorrelationHasTheLinearErrorBarOfTheOffset) {
  GENU_NEEDS_LENHART();
  const test::TemporaryFolder folder;
  constexpr double kSd = 0.002, kLength = 5000;  // mm: over the knee the field is one number
  const Sweep sweep =
      ready_knee_sweep(folder, "\"femur_cartilage.mesh_error\" = { sd = 0.002, correlation_length = 5000 }", 24);
  const auto numbers = solved(sweep);
  SensitivityResult linear;
  Diagnostics out;
  const std::vector<std::string> offset = {"femur_cartilage.offset"};
  ASSERT_TRUE(solve_and_differentiate(sweep.cases[0].prepared, {kColumns, offset, 1}, {}, out, linear))
      << test::messages(out);
  std::vector<double> heights;
  for (std::uint64_t i = 0; i < 24; ++i)
    heights.push_back(1e3 * noise_field({Vec3::Zero()}, {1e-3 * kSd, 1e-3 * kLength},
                                        static_cast<std::uint64_t>(sweep.design.draws(i)[0]))[0]);
  // Where a derivative is small, the rest of the field shows, and that vertices of a coarse mesh move along normals of
  // their own: a sample's error is measured in the largest bar of its unit.
  std::map<std::string, double> largest_off, largest_bar;
  for (std::size_t k = 0; k < sweep.kept.size(); ++k) {
    const std::size_t row = sweep.kept[k].value == 30 ? 2 : 4;
    std::size_t output = 0;
    while (linear.rows.outputs[output].column != sweep.kept[k].column) ++output;
    const double per_mm = linear.rows.derivative(row, output, 0);
    const double here = linear.solution.poses.number(row, sweep.kept[k].column);
    const double sd = moments(numbers[k]).sd, bar = std::abs(per_mm) * kSd;
    double off = 0;
    for (std::size_t i = 0; i < heights.size(); ++i)
      off = std::max(off, std::abs(numbers[k][i] - here - per_mm * heights[i]));
    std::printf("%-22s sd %.6f, linear %.6f; a sample is off by %.6f at most\n", sweep.kept[k].name.c_str(), sd, bar,
                off);
    const std::string unit = sweep.kept[k].column.ends_with("_mm") ? "mm" : "deg";
    largest_off[unit] = std::max(largest_off[unit], off);
    largest_bar[unit] = std::max(largest_bar[unit], bar);
    EXPECT_NEAR(sd, bar, 4 * bar / std::sqrt(2 * 24.0)) << sweep.kept[k].name;
  }
  for (const char* unit : {"mm", "deg"}) EXPECT_LT(largest_off[unit], 0.05 * largest_bar[unit]) << unit;
}

/// The error that genu sees in a mesh itself: as wide as `--error-bars` draws it, with more draws than its three.
TEST(MeshError, EstimatedIsAsWideAsErrorBarsOfNoise) {
  GENU_NEEDS_LENHART();
  const test::TemporaryFolder folder;
  constexpr int kDraws = 24;
  const Sweep sweep = ready_knee_sweep(folder, "\"*.mesh_error\" = { estimated = true }", kDraws);
  const auto numbers = solved(sweep);
  const Prepared& base = sweep.cases[0].prepared;
  std::vector<std::vector<double>> drawn(sweep.kept.size());
  for (std::uint64_t seed = 101; seed <= 100 + kDraws; ++seed) {
    const auto other = vary(base, mesh_noises(base), {ErrorCause::noise, "", 0, 1, seed});
    ASSERT_TRUE(other);
    ContactField field(other->model);
    const Solved path = solve_path(*other, field, {});
    const ResultTable table = pose_table(other->scene, other->model, other->steps, path.records);
    const auto kept = kept_values(sweep.kept, sweep.cases[0].main, table, path.complete());
    for (std::size_t k = 0; k < kept.size(); ++k) drawn[k].push_back(kept[k]);
  }
  for (std::size_t k = 0; k < sweep.kept.size(); ++k) {
    const Moments mine = moments(numbers[k]), bars = moments(drawn[k]);
    ASSERT_EQ(bars.count, kDraws);
    std::printf("%-22s sd %.4f, of error bars %.4f\n", sweep.kept[k].name.c_str(), mine.sd, bars.sd);
    // Both are estimates of one standard deviation: four standard errors of their logarithms' difference.
    EXPECT_LT(std::abs(std::log(mine.sd / bars.sd)), 4 * std::sqrt(2 / (2.0 * kDraws))) << sweep.kept[k].name;
    EXPECT_LT(std::abs(mine.mean - bars.mean), 4 * std::hypot(mine.sd, bars.sd) / std::sqrt(kDraws));
  }
}

}  // namespace
}  // namespace genu
