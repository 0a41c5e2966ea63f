// Error bars of a measured knee, held to what they are to cover: other sound fits than those they are made of, and the
// finest mesh.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/core/timer.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/study/run_scene.h"
#include "genu/surface/analytic.h"
#include "support/crank_scene.h"
#include "support/judged.h"
#include "support/knee_scene.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

#define GENU_NEEDS_LENHART() GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl")

const std::vector<std::string> kPoseColumns = {"knee.adduction_deg", "knee.rotation_deg", "knee.x_mm",
                                               "knee.y_mm",          "knee.z_mm",         "tibiofemoral.force_N"};

struct TimedRun {
  Solution solution;
  double seconds = 0;  ///< from the files to the table
};

TimedRun run(const std::string& text, bool error_bars) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", text);
  RunOptions options;
  options.error_bars = error_bars;
  int told = 0, asked = 0;
  options.varied_progress = [&](int done, int all) {
    EXPECT_GT(done, told);
    told = done;
    asked = all;
  };
  Diagnostics out;
  TimedRun result;
  const Timer timer;
  EXPECT_EQ(run_scene(scene, folder / "out", options, out, &result.solution), kExitOk);
  result.seconds = timer.seconds();
  test::expect_judged_ok(scene, result.solution.poses);
  EXPECT_EQ(told, asked);
  EXPECT_EQ(asked > 0, error_bars);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  return result;
}

/// The published scene with the fits given.
std::string with_fits(const std::string& text, int degree, double femur_mm, double tibia_mm) {
  std::string out = text;
  for (const auto& [name, radius] : {std::pair("femur", femur_mm), std::pair("tibia", tibia_mm)})
    out = test::replaced(out, fmt::format("[surface.{}_cartilage]\n", name),
                         fmt::format("[surface.{}_cartilage]\nfit_radius = {}\ndegree = {}\n", name, radius, degree));
  return out;
}

/// The part of the rows in which `other` lies within the bars of `with_bars`, of the column where it is least.
double covered(const Solution& with_bars, const Solution& other, const std::string& what) {
  double least = 1;
  const ResultTable& bars = with_bars.error_bars->bars;
  for (const std::string& column : kPoseColumns) {
    int within = 0;
    double squares = 0, bar_squares = 0;
    for (std::size_t row = 0; row < bars.rows(); ++row) {
      const double away = other.poses.number(row, column) - with_bars.poses.number(row, column);
      within += std::abs(away) <= bars.number(row, column);
      squares += away * away;
      bar_squares += std::pow(bars.number(row, column), 2);
    }
    const auto rows = static_cast<double>(bars.rows());
    least = std::min(least, within / rows);
    std::printf("%-28s %-22s away %7.3f rms, bar %7.3f rms, %3.0f %% of the rows covered\n", what.c_str(),
                column.c_str(), std::sqrt(squares / rows), std::sqrt(bar_squares / rows), 100 * within / rows);
  }
  return least;
}

constexpr double kCovered = 0.95;

TEST(ErrorBarsOfARealKnee, CoverOtherSoundFitsInLessThanTenTimesTheTime) {
  GENU_NEEDS_LENHART();
  const std::string text = test::lenhart_scene("", 0, 90, 45);
  const TimedRun plain = run(text, false), bars = run(text, true);
  EXPECT_FALSE(plain.solution.error_bars.has_value());
  ASSERT_TRUE(bars.solution.error_bars.has_value());
  EXPECT_EQ(plain.solution.poses.to_csv(), bars.solution.poses.to_csv()) << "bars change no result";
  for (const RunSummary::Variant& v : bars.solution.summary.variants) EXPECT_EQ(v.poses_solved, 46) << v.name;
  std::printf("with bars %.1f times the time\n", bars.seconds / plain.seconds);
  EXPECT_LT(bars.seconds, 10 * plain.seconds);
  for (const auto& [degree, femur, tibia] :
       {std::tuple(3, 5.0, 8.5), std::tuple(3, 6.5, 7.0), std::tuple(4, 7.0, 8.5), std::tuple(2, 5.0, 6.5)})
    EXPECT_GE(covered(bars.solution, run(with_fits(text, degree, femur, tibia), false).solution,
                      fmt::format("degree {}, {} and {} mm", degree, femur, tibia)),
              kCovered);
}

TEST(ErrorBarsOfARealKnee, CoarserMeshesReachToTheFinest) {
  GENU_NEEDS_LENHART();
  const TimedRun finest = run(test::lenhart_scene("", 0, 90, 45), false);
  for (const std::string resolution : {"-medium", "-coarse", "-wicked-coarse"}) {
    const TimedRun coarse = run(test::lenhart_scene(resolution, 0, 90, 45), true);
    ASSERT_TRUE(coarse.solution.error_bars.has_value());
    EXPECT_GE(covered(coarse.solution, finest.solution, resolution.substr(1)), kCovered);
  }
}

TEST(ErrorBarsOfARealKnee, AreTheSameBytesEveryTime) {
  GENU_NEEDS_LENHART();
  const std::string text = test::lenhart_scene("-coarse", 0, 30, 3);
  const TimedRun a = run(text, true), b = run(text, true);
  EXPECT_EQ(a.solution.error_bars->bars.to_csv(), b.solution.error_bars->bars.to_csv());
  EXPECT_EQ(a.solution.error_bars->shares.to_csv(), b.solution.error_bars->shares.to_csv());
}

/// A cord over an ellipsoid as triangles: its length differs from that over the formula by less than its bar.
TEST(ErrorBars, OfACordOverAMeshCoverTheSmoothShape) {
  const test::TemporaryFolder folder;
  const std::string cord = R"([ligament.cord]
from = { body = "frame", point = [-50, 12, 2] }
to = { body = "crank", point = [40, 5, -1] }
wrap = [{ surface = "egg", side = [0, 1, 0] }]
law = "spring"
stiffness = 5
slack_length = 10
[[step]]
prescribe = { "hinge.angle" = [0, -30] }
increments = 6
)";
  const auto egg = make_ellipsoid({}, Vec3(0.012, 0.009, 0.015), false);
  const std::string file = folder / "egg.ply";
  ASSERT_EQ(write_ply(egg->triangles(2.5e-3, Vec3::Zero(), 0.1), file, 1e-3, ""), "");
  const auto on = [&](const std::string& shape) {
    return test::crank_scene("[surface.egg]\nbody = \"frame\"\n" + shape + "\n" + cord);
  };
  const Solution meshed = run(on("shape = \"mesh\"\nfile = \"" + file + "\"\nunits = \"mm\""), true).solution;
  const Solution smooth = run(on("shape = \"ellipsoid\"\nradii = [12, 9, 15]"), false).solution;
  ASSERT_TRUE(meshed.error_bars);
  const ResultTable& bars = meshed.error_bars->bars;
  ASSERT_EQ(bars.rows(), 7u);
  for (std::size_t row = 0; row < bars.rows(); ++row) {
    const double bar = bars.number(row, "cord.length_mm");
    EXPECT_LT(std::abs(meshed.poses.number(row, "cord.length_mm") - smooth.poses.number(row, "cord.length_mm")), bar);
    EXPECT_NEAR(bars.number(row, "cord.force_N"), 5 * bar, 1e-9 * bar);
    EXPECT_LT(bar, 0.1);
  }
}

TEST(ErrorBars, ClosedFormsHaveNone) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.error_bars = true;
  Diagnostics out;
  Solution solution;
  ASSERT_EQ(run_scene(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml", folder / "out", options, out,
                      &solution),
            kExitOk);
  EXPECT_FALSE(solution.error_bars.has_value());
  EXPECT_TRUE(solution.summary.variants.empty());
}

}  // namespace
}  // namespace genu
