#include "genu/store/report_limits.h"

#include <gtest/gtest.h>

#include "genu/mesh/mesh.h"
#include "results/report_case.h"

namespace genu {
namespace {

/// A square of `n` x `n` cells, two triangles each.
ReportMesh plate_of(const std::string& name, int n) {
  ReportMesh mesh;
  mesh.name = name;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.vertices.emplace_back(1e-3 * i, 1e-3 * j, 0);
  const auto at = [&](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  mesh.triangles_in_full = mesh.triangles.size();
  return mesh;
}

TEST(ReportLimits, TheLargestMeshesAreThinnedUntilAllFit) {
  std::vector<ReportMesh> meshes = {plate_of("small", 20), plate_of("large", 100), plate_of("larger", 140)};
  thin_meshes(meshes, 10'800);
  EXPECT_EQ(meshes[0].triangles.size(), 800u) << "it has less than its share";
  EXPECT_GT(meshes[1].triangles.size() + meshes[2].triangles.size(), 5'000u) << "the others share what is left";
  EXPECT_LE(meshes[1].triangles.size(), 5'000u);
  EXPECT_LE(meshes[2].triangles.size(), 5'000u);
  EXPECT_EQ(meshes[2].triangles_in_full, 39'200u);
  std::vector<ReportMesh> all = {plate_of("small", 20)};
  thin_meshes(all, 800);
  EXPECT_EQ(all[0].triangles.size(), 800u);
}

TEST(ReportLimits, AreSaidInWords) {
  test::ReportCase base;
  ReportRun run = base.run();
  run.meshes = {plate_of("ball", 20)};
  run.chart.events.resize(5);
  run.beside = {
      {"measured.csv", {{"knee.flexion_deg", "angle", {0, 1, 2, 3, 4}}, {"ACL.force_N", "F", {5, 6, 7, 8, 9}}}}};
  run.scene_text = "format = 1\ntitle = \"knee\"\n";
  ReportLimits limits;
  cut_lists(run, limits);
  EXPECT_TRUE(left_out(run).empty());
  limits.events = 3;
  limits.measured = 4;
  limits.scene_text = 15;
  cut_lists(run, limits);
  run.meshes[0].triangles_in_full = 4'995'224;
  run.rows_in_full = 30'000;
  run.every = 12;
  ReportPressure map;
  map.every = 22;
  run.pressures = {map};
  EXPECT_EQ(left_out(run), (std::vector<std::string>{
                               "every 12th of 30,000 rows (results.csv has all)", "800 of 4,995,224 triangles of ball",
                               "pressures of every 22nd of its rows", "3 of 5 events (events.csv has all)",
                               "every 3rd row of measured.csv", "10 of 26 bytes of the scene"}));
  EXPECT_EQ(run.beside[0].columns[1].numbers, (std::vector<double>{5, 8}));
  EXPECT_EQ(run.scene_text, "format = 1") << "whole lines";
  run.meshes.push_back(plate_of("dish", 10));
  run.meshes.back().triangles_in_full = 1'000;
  EXPECT_EQ(left_out(run)[1], "1,000 of 4,996,224 triangles of 2 meshes");
}

}  // namespace
}  // namespace genu
