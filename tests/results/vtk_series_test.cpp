// Which files a series has, and that what stands in them is where the bodies are.
#include "genu/results/vtk_series.h"

#include <map>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "results/report_case.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

using test::contains;

struct Files {
  std::map<std::string, std::string> texts;
  WriteFile write() {
    return [this](const std::string& name, const std::string& content) {
      EXPECT_TRUE(texts.emplace(name, content).second) << name << " is written twice";
      return std::string();
    };
  }
};

TEST(VtkSeries, ABodyThatRestsIsWrittenOnceAndNamedAtEachTime) {
  const test::ReportCase one;
  ReportRun run = one.run();
  run.body_poses[1] = run.body_poses[0];
  run.meshes.push_back({"bone under x", 0, ReportMesh::Kind::bone, run.meshes[0].vertices, {{0, 1, 2}}, 1});
  Files files;
  VtkSeries series(run, 2, files.write());
  EXPECT_EQ(series.add({0, 3, 0.5}), "");
  EXPECT_EQ(series.add({1, 12, 1.5}), "");
  EXPECT_EQ(series.finish(), "");
  std::vector<std::string> names;
  for (const auto& [name, text] : files.texts) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"poses.pvd", "vtp/bone_under_x.vtp", "vtp/ligaments.03.vtp",
                                             "vtp/ligaments.12.vtp", "vtp/plate.03.vtp", "vtp/plate.12.vtp"}));
  EXPECT_EQ(test::occurrences(files.texts["poses.pvd"], "file=\"vtp/bone_under_x.vtp\""), 2);
  EXPECT_TRUE(contains(files.texts["poses.pvd"], "timestep=\"1.5\" group=\"\" part=\"0\" name=\"plate\""));
  EXPECT_TRUE(contains(files.texts["vtp/ligaments.12.vtp"], "NumberOfLines=\"1\""));
}

TEST(VtkSeries, PointsStandInTheScenesOwnWorldInMillimetres) {
  test::ReportCase one;
  one.model.bodies[0].centre = Vec3(0, 7, 0);  // the fixed frame as the file has it lies 7 m off
  const ReportRun run = one.run();
  Files files;
  VtkSeries series(run, 1, files.write());
  ASSERT_EQ(series.add({0, 1, 0}), "");
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto mesh = read_mesh(folder.write("plate.vtp", files.texts["vtp/plate.1.vtp"]), 1, out);
  ASSERT_TRUE(mesh.has_value());
  ASSERT_EQ(mesh->vertices.size(), 3u);
  EXPECT_NEAR((mesh->vertices[0] - Vec3(1000002, 7000, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((mesh->vertices[2] - Vec3(1000002, 7010, 0)).norm(), 0, 1e-6);
}

TEST(VtkSeries, StopsWhereAFileCannotBeWritten) {
  const test::ReportCase one;
  const ReportRun run = one.run();
  int written = 0;
  VtkSeries series(run, 1, [&](const std::string&, const std::string&) {
    return ++written == 2 ? std::string("disk full") : std::string();
  });
  EXPECT_EQ(series.add({0, 1, 0}), "disk full");
  EXPECT_EQ(written, 2);
}

}  // namespace
}  // namespace genu
