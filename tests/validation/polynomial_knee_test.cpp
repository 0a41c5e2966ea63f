// The knee of meshes/lenhart_polynomial: solved throughout, near the measured knee it was fitted to, made by the
// commands it says, and approached by meshes of itself with the order that meshes promise: mesh against formula on a
// real shape.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/model/build_model.h"
#include "genu/shape_fit/chart_mesh.h"
#include "genu/study/fit_scene.h"
#include "knee_run.h"
#include "mesh_study.h"
#include "support/judged.h"
#include "support/knee_scene.h"
#include "support/places.h"
#include "support/ssm_scene.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

using test::KneeRun;

const std::string kKnee = genu::test::source_folder() + "/meshes/lenhart_polynomial/";

#define GENU_NEEDS_MEASURED_KNEE() GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl")

KneeRun run_file(const std::string& path) {
  KneeRun run;
  Diagnostics diagnostics;
  run.prepared = prepare(path, diagnostics);
  for (const Diagnostic& d : diagnostics.items()) ADD_FAILURE() << to_string(d);
  if (!run.prepared) return run;
  ContactField field(run.prepared->model);
  run.solution = test::judged(*run.prepared, solve(*run.prepared, field, {}));
  return run;
}

const KneeRun& polynomial_knee() {
  static const KneeRun run = run_file(kKnee + "scene.toml");
  return run;
}

TEST(PolynomialKnee, EveryPoseIsCertifiedStableAndInsideThePatches) {
  const KneeRun& run = polynomial_knee();
  ASSERT_EQ(run.solution.records.size(), 91u);
  double edge = 1;
  for (const PoseRecord& r : run.solution.records) {
    ASSERT_EQ(r.point.report.status, PoseStatus::ok) << r.point.increment << ": " << r.point.report.why;
    const Certificate& c = r.point.report.certificate;
    EXPECT_LE(c.residual, 1e-8);
    EXPECT_GE(c.smallest_force, 0);
    EXPECT_GE(c.smallest_gap, -1e-12);
    EXPECT_LT(c.least_opposed, -0.999999);
    EXPECT_EQ(r.point.stability.verdict, Stability::Verdict::stable) << r.point.increment;
    edge = std::min(edge, c.edge_distance);
  }
  std::printf("contacts stay %.2f mm inside the patches\n", 1e3 * edge);
  EXPECT_GE(edge, 2e-3);
}

TEST(PolynomialKnee, LiesNearTheMeasuredKnee) {
  GENU_NEEDS_MEASURED_KNEE();
  const test::TemporaryFolder folder;
  const KneeRun measured = run_file(folder.write("scene.toml", test::lenhart_scene("", 0, 90, 90)));
  const auto differences =
      pose_differences(measured.prepared->scene, measured.solution.poses, polynomial_knee().solution.poses);
  ASSERT_EQ(differences.size(), 6u);
  for (const auto& [name, worst] : differences) {
    std::printf("  %-22s %.3f\n", name.c_str(), worst);
    EXPECT_LE(worst, name == "knee.rotation_deg" ? 2 : 0.5) << name;
  }
}

TEST(PolynomialKnee, IsWhatFitMakesOfTheMeasuredKnee) {
  GENU_NEEDS_MEASURED_KNEE();
  const test::TemporaryFolder folder;
  FitSceneRequest request;
  request.file = folder.write("scene.toml", test::lenhart_scene("", 0, 90, 90));
  Diagnostics out;
  const auto fits = fit_scene(request, folder / "out", out);
  ASSERT_TRUE(fits);
  const PlacedScene& shipped = polynomial_knee().prepared->scene;
  ASSERT_EQ(fits->fits.size(), shipped.surfaces.size());
  double worst = 0;
  for (const NamedFit& named : fits->fits) {
    const auto s = std::find_if(shipped.surfaces.begin(), shipped.surfaces.end(),
                                [&](const SurfaceDef& def) { return def.name == named.name; });
    ASSERT_NE(s, shipped.surfaces.end()) << named.name;
    const auto shipped_surface = make_analytic_surface(*s), fitted = named.fit.surface();
    for (const Vec3& v : chart_mesh(named.fit.chart, named.fit.patch, named.fit.terms, named.fit.inside, 2e-3).vertices)
      worst = std::max(worst, std::abs(*shipped_surface->gap(v)));
    EXPECT_LT(named.fit.residual.rms, 1e-4);
  }
  std::printf("fitted again: off by %.1e mm\n", 1e3 * worst);
  EXPECT_LT(worst, 1e-8);
}

class FittedShapeModelKnee : public testing::TestWithParam<const char*> {};

TEST_P(FittedShapeModelKnee, IsSolvedThroughoutNearItsMeshes) {
  GENU_NEEDS_DATA("lenhart2015/lenhart_ligaments.json");
  GENU_NEEDS_DATA("ssm/mean_ligaments.json");
  const test::TemporaryFolder folder;
  FitSceneRequest request;
  request.file = folder.write("scene.toml", test::ssm_scene(GetParam(), 90, 30));
  Diagnostics out;
  const auto fits = fit_scene(request, folder / "out", out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  ASSERT_TRUE(fits);
  const KneeRun run = run_file(folder.write("fitted.toml", fits->scene));
  EXPECT_TRUE(all_solved(run.solution.summary.exit_code));
  EXPECT_EQ(run.solution.summary.poses_stable, 31);
  for (const auto& [name, worst] : pose_differences(run.prepared->scene, fits->solution.poses, run.solution.poses)) {
    std::printf("  %-22s %.3f\n", name.c_str(), worst);
    EXPECT_LE(worst, name == "knee.rotation_deg" ? 2 : 0.6) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(PolynomialKnee, FittedShapeModelKnee, testing::Values("mean", "S001", "S002"),
                         [](const auto& p) { return std::string(p.param); });

TEST(PolynomialKnee, ItsMeshesAreWhatMeshMakes) {
  for (const double edge : {4e-3, 2e-3}) {
    const std::string folder = fmt::format("{}stl-{:g}mm/", kKnee, 1e3 * edge);
    const Prepared& knee = *polynomial_knee().prepared;
    for (std::size_t k = 0; k < knee.surfaces.size(); ++k) {
      Diagnostics out;
      const auto shipped = read_mesh(folder + knee.scene.surfaces[k].name + ".stl", units::kMillimetre, out);
      ASSERT_TRUE(shipped);
      const Mesh made = knee.surfaces[k]->triangles(edge, Vec3::Zero(), 0.05);
      ASSERT_EQ(made.triangles.size(), shipped->triangles.size());
      double worst = 0;
      for (std::size_t t = 0; t < made.triangles.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c)
          worst = std::max(worst, (made.vertices[static_cast<std::size_t>(made.triangles[t][c])] -
                                   shipped->vertices[static_cast<std::size_t>(shipped->triangles[t][c])])
                                      .norm());
      EXPECT_LT(worst, 1e-8) << knee.scene.surfaces[k].name;
    }
  }
}

/// The knee with its polynomials cut into triangles, written as STL and read back.
test::MeshStudyRow measure(const Prepared& exact, const Solution& reference, double edge) {
  test::MeshStudyRow row;
  row.edge = edge;
  const test::TemporaryFolder folder;
  Prepared p;
  p.scene = exact.scene;
  p.steps = exact.steps;
  Diagnostics problems;
  MeshLibrary meshes;
  for (std::size_t k = 0; k < p.scene.surfaces.size(); ++k) {
    SurfaceDef& def = p.scene.surfaces[k];
    const std::string file = folder / (def.name + ".stl");
    row.failure += write_stl(exact.surfaces[k]->triangles(edge, Vec3::Zero(), 0.05), file, units::kMillimetre, "");
    def.shape = SurfaceDef::Shape::mesh;
    def.placement = Pose{};
    def.patch.reset();
    def.file = file;
    def.file_unit = units::kMillimetre;
  }
  p.surfaces = build_surfaces(p.scene, meshes, p.notes, p.seconds, problems);
  if (!problems.has_errors())
    if (auto model = build_model(p.scene, p.surfaces, problems)) p.model = std::move(*model);
  if (problems.has_errors()) {
    row.failure = to_string(problems.items().front());
    return row;
  }
  for (const auto& surface : p.surfaces) {
    const auto& blend = dynamic_cast<const BlendSurface&>(*surface);
    row.triangles += blend.mesh().triangles.size();
    row.median_edge += blend.facts().median_edge / static_cast<double>(p.surfaces.size());
  }
  ContactField field(p.model);
  const Solution found = solve(p, field, {});
  if (found.summary.exit_code != kExitOk) row.failure = found.summary.verdict.front();
  for (std::size_t i = 0; i < std::min(found.records.size(), reference.records.size()); ++i) {
    const Pose &X = reference.records[i].point.pose.state.poses.back(),
               &Y = found.records[i].point.pose.state.poses.back();
    row.position_error = std::max(row.position_error, (X.p - Y.p).norm());
    row.rotation_error = std::max(row.rotation_error, log_rotation(Y.R * X.R.transpose()).norm());
  }
  return row;
}

TEST(PolynomialKnee, MeshesOfItConverge) {
  const KneeRun& run = polynomial_knee();
  ASSERT_EQ(run.solution.summary.exit_code, kExitOk);
  std::vector<test::MeshStudyRow> rows;
  fmt::print("| edge mm | triangles | position mm | rotation deg |\n|---:|---:|---:|---:|\n");
  for (const double edge : {2.0e-3, 1.4e-3, 1.0e-3, 0.7e-3}) {
    rows.push_back(measure(*run.prepared, run.solution, edge));
    const test::MeshStudyRow& r = rows.back();
    EXPECT_EQ(r.failure, "") << "edge " << 1e3 * edge << " mm";
    fmt::print("| {:.1f} | {} | {:.1e} | {:.1e} |\n", 1e3 * edge, r.triangles, 1e3 * r.position_error,
               r.rotation_error / units::kDegree);
  }
  const double position = test::observed_order(rows, [](const auto&r) { return r.position_error; }),
               rotation = test::observed_order(rows, [](const auto&r) { return r.rotation_error; });
  fmt::print("| observed order | | {:.1f} | {:.1f} |\n", position, rotation);
  EXPECT_GE(position, 3);
  EXPECT_LT(rows.back().position_error, 0.01e-3);
}

}  // namespace
}  // namespace genu
