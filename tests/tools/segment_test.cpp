// genu segment, run as a user runs it.
#include <filesystem>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_writer.h"
#include "genu/surface/analytic.h"
#include "support/csv_table.h"
#include "support/data.h"
#include "support/dirt.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

std::string written_ring(const TemporaryFolder& folder, const Mesh& mesh) {
  EXPECT_EQ(write_mesh(mesh, folder / "ring.stl", 1e-3, "test"), "");
  return folder / "ring.stl";
}

Mesh ring() { return make_torus({}, 0.015, 0.005, false)->triangles(1e-3, Vec3::Zero(), 1); }

TEST(CliSegment, WritesPiecesAndAFragmentOfAScene) {
  const TemporaryFolder folder;
  const std::string file = written_ring(folder, ring());
  const std::string command = "segment " + file + " --pieces 6 --name m --below plateau --out " + (folder / "pieces");
  for (int again = 0; again < 2; ++again) {  // what it wrote itself is replaced
    const Outcome done = genu(command);
    ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
    EXPECT_TRUE(contains(done.out, "6 pieces of 15.7 mm along the centreline")) << done.out;
    EXPECT_TRUE(contains(done.out, "6 bushings, a ring")) << done.out;
  }
  for (const char* name : {"m_01.stl", "m_06.stl", "m_06_above.stl", "m_06_below.stl", "m.toml"})
    EXPECT_TRUE(std::filesystem::exists(folder / ("pieces/" + std::string(name)))) << name;
  const Outcome piece = genu("mesh-check " + (folder / "pieces/m_01.stl"));
  EXPECT_TRUE(contains(piece.out, "closed; centroid")) << piece.out;
}

TEST(CliSegment, RefusesFlawsFilesOfOthersAndBadNames) {
  const TemporaryFolder folder;
  const std::string out = " --out " + (folder / "pieces");
  const std::string dirty = written_ring(folder, dirtied(ring(), Dirt::hole, {0.02, 0, 0}, 2e-3));
  const Outcome flawed = genu("segment " + dirty + out);
  EXPECT_EQ(flawed.exit_code, 2);
  EXPECT_TRUE(contains(flawed.err, "hole")) << flawed.err;
  const std::string good = written_ring(folder, ring());
  EXPECT_EQ(genu("segment " + good + " --name \"a b\"" + out).exit_code, 2);
  EXPECT_EQ(genu("segment " + good + " --pieces 2" + out).exit_code, 2);
  std::filesystem::create_directories(folder / "pieces");
  folder.write("pieces/ring.toml", "format = 1\n");
  const Outcome taken = genu("segment " + good + out);
  EXPECT_EQ(taken.exit_code, 2);
  EXPECT_TRUE(contains(taken.err, "will not be replaced")) << taken.err;
}

/// The measured menisci in 2 x 8 pieces, on the way from extension to 20 deg: no jump, and each is in tension.
TEST(CliSegment, TheMeasuredKneeBendsOnItsPieces) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-med-meniscus.stl");
  const TemporaryFolder folder;
  const Outcome made =
      shell("GENU_DATA=" + data_path("") + " " + source_folder() + "/tools/segmented-knee --pieces 8 " +
            "--flexion 20 --rows 4 --genu " + program() + " " + (folder / "knee"));
  ASSERT_EQ(made.exit_code, 0) << made.out << made.err;
  const Outcome run = genu("run " + (folder / "knee/scene.toml") + " --no-report --out " + (folder / "run"));
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.err;
  EXPECT_TRUE(contains(run.out, "poses       5 of 5 solved")) << run.out;
  EXPECT_FALSE(contains(run.out, "jumped")) << run.out;
  EXPECT_FALSE(contains(run.out, "% of its thickness")) << run.out;
  const ResultTable table = read_table(folder / "run/results.csv");
  for (const char* cut : {"meniscus_medial_hoop_03", "meniscus_medial_hoop_05", "meniscus_lateral_hoop_04"})
    for (std::size_t row = 0; row < table.rows(); ++row)
      EXPECT_LT(table.number(row, std::string(cut) + ".force_x_N"), 0) << cut << " at " << row;
}

}  // namespace
}  // namespace genu::test
