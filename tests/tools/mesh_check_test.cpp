// genu mesh-check, run as a user runs it.
#include <filesystem>

#include <gtest/gtest.h>

#include "genu/geometry/analytic.h"
#include "genu/geometry/mesh_intersections.h"
#include "genu/geometry/mesh_reader.h"
#include "genu/geometry/stl_writer.h"
#include "support/dirt.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

bool contains(const std::string& text, const std::string& piece) { return text.find(piece) != std::string::npos; }

Mesh torus() { return make_torus({}, 0.015, 0.005, false)->triangles(1e-3, Vec3::Zero(), 1); }

std::string written(const TemporaryFolder& folder, const std::string& name, const Mesh& mesh, double unit = 1e-3) {
  EXPECT_EQ(write_stl(mesh, folder / name, unit, "test"), "");
  return folder / name;
}

TEST(CliMeshCheck, SaysALineAQuestion) {
  const TemporaryFolder folder;
  const Outcome good = genu("mesh-check " + written(folder, "good.stl", torus()));
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_TRUE(contains(good.out, "units mm (guessed"));
  for (const char* question : {"components", "holes", "duplicate vertices", "degenerate faces", "sliver faces",
                               "non-manifold edges", "non-manifold vertices", "flipped faces", "self-intersections",
                               "inside-out pieces", "noise", "curvature", "thickness"})
    EXPECT_TRUE(contains(good.out, question)) << question;
  EXPECT_TRUE(contains(genu("mesh-check " + written(folder, "m.stl", torus(), 1)).out, "units m (guessed"));
  const Outcome dirty =
      genu("mesh-check " + written(folder, "dirty.stl", dirtied(torus(), Dirt::hole, {0.02, 0, 0}, 2e-3)) + " " +
           (folder / "good.stl"));
  EXPECT_EQ(dirty.exit_code, 3);
  EXPECT_TRUE(contains(dirty.out, "BAD")) << dirty.out;
  EXPECT_TRUE(contains(dirty.out, "good.stl: read")) << "the next file is looked at all the same";
}

TEST(CliMeshCheck, RefusesWhatCannotBeRead) {
  const TemporaryFolder folder;
  const Outcome none = genu("mesh-check " + (folder / "none.stl"));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_TRUE(contains(none.err, "no such mesh file")) << none.err;
  EXPECT_EQ(genu("mesh-check " + folder.write("junk.stl", std::string(500, 'x'))).exit_code, 2);
  EXPECT_EQ(genu("mesh-check").exit_code, 2);
  EXPECT_EQ(genu("mesh-check " + written(folder, "a.stl", torus()) + " --units km").exit_code, 2);
  const std::string two = written(folder, "b.stl", torus());
  EXPECT_EQ(genu("mesh-check " + two + " " + two + " --repair " + (folder / "c.stl")).exit_code, 2);
  EXPECT_EQ(genu("mesh-check " + two + " --repair " + two).exit_code, 2) << "onto itself";
}

TEST(CliMeshCheck, RepairsOrSaysThatItCannot) {
  const TemporaryFolder folder;
  const std::string dirty = written(folder, "dirty.stl", dirtied(torus(), Dirt::crossing, {0.02, 0, 0}, 2e-3)),
                    mended = folder / "mended.stl";
  const Outcome repair = genu("mesh-check " + dirty + " --repair " + mended);
  if (!built_with_cgal()) {
    EXPECT_EQ(repair.exit_code, 2);
    EXPECT_TRUE(contains(repair.err, "built without CGAL")) << repair.err;
    EXPECT_FALSE(std::filesystem::exists(mended));
    return;
  }
  EXPECT_EQ(repair.exit_code, 0) << repair.out << repair.err;
  EXPECT_TRUE(contains(repair.out, "no vertex that stays was moved")) << repair.out;
  EXPECT_EQ(genu("mesh-check " + mended).exit_code, 0);
  const Outcome nowhere = genu("mesh-check " + dirty + " --repair " + (folder / "no/such/folder.stl"));
  EXPECT_EQ(nowhere.exit_code, 1) << nowhere.err;
}

}  // namespace
}  // namespace genu::test
