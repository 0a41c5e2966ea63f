// genu mesh-check, run as a user runs it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>

#include "genu/mesh_care/mesh_repair.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/surface/analytic.h"
#include "support/dirt.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

Mesh torus() { return make_torus({}, 0.015, 0.005, false)->triangles(1e-3, Vec3::Zero(), 1); }

std::string written(const TemporaryFolder& folder, const std::string& name, const Mesh& mesh, double unit = 1e-3) {
  EXPECT_EQ(write_mesh(mesh, folder / name, unit, "test"), "");
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

TEST(CliMeshCheck, RepairReplacesNothingButMeshFiles) {
  const TemporaryFolder folder;
  const std::string mesh = written(folder, "good.stl", torus()), scene = folder.write("scene.toml", kBall),
                    part = folder.write("out.stl.part", "mine"), target = folder.write("target.stl", "kept");
  std::filesystem::create_symlink(target, folder / "link.stl");
  std::filesystem::create_directory(folder / "folder.stl");
  ASSERT_EQ(std::system(("mkfifo " + (folder / "fifo.stl")).c_str()), 0);
  for (const std::string& out : {scene, folder / "link.stl", folder / "folder.stl", folder / "fifo.stl",
                                 std::string("/dev/null"), folder / "noending", std::string("''")}) {
    const Outcome refused = genu("mesh-check " + mesh + " --repair " + out);
    EXPECT_EQ(refused.exit_code, 2) << out << "\n" << refused.err;
    EXPECT_FALSE(refused.err.empty()) << out;
  }
  EXPECT_EQ(read_file(scene), kBall);
  EXPECT_EQ(read_file(target), "kept");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.stl") && std::filesystem::is_fifo(folder / "fifo.stl"));
  if (!built_with_cgal()) return;
  EXPECT_EQ(genu("mesh-check " + mesh + " --repair " + (folder / "out.stl")).exit_code, 0);
  EXPECT_EQ(read_file(part), "mine");
}

/// What the second table says is what the file has.
TEST(CliMeshCheck, AMeshFarFromItsOriginIsMendedWithAllItsDigits) {
  if (!built_with_cgal()) GTEST_SKIP() << "nothing is mended without CGAL";
  const TemporaryFolder folder;
  Mesh far = torus();
  for (Vec3& v : far.vertices) v += Vec3(1000, 1000, 1000);
  for (const std::string name : {"far.stl", "far.ply", "far.obj"}) {
    ASSERT_EQ(write_mesh(far, folder / "in.ply", 1e-3, "test"), "");
    const Outcome repair = genu("mesh-check " + (folder / "in.ply") + " --repair " + (folder / name));
    EXPECT_EQ(repair.exit_code, 0) << repair.out << repair.err;
    Diagnostics out;
    const auto mended = read_mesh(folder / name, 1e-3, out);
    ASSERT_TRUE(mended) << name;
    double worst = 0;
    for (const Vec3& v : far.vertices) {  // STL keeps another order
      double nearest = 1;
      for (const Vec3& w : mended->vertices) nearest = std::min(nearest, (w - v).norm());
      worst = std::max(worst, nearest);
    }
    EXPECT_EQ(mended->triangles.size(), far.triangles.size()) << name;
    std::printf("%s: vertices move by at most %.1e m\n", name.c_str(), worst);
    EXPECT_LT(worst, 1e-9) << name;
  }
}

TEST(CliMeshCheck, SaysWhatItMeasures) {
  const TemporaryFolder folder;
  Mesh rough = torus();
  for (Vec3& v : rough.vertices)
    for (int k = 0; k < 3; ++k) v[k] = std::round(v[k] * 1e5) / 1e5;
  EXPECT_TRUE(contains(genu("mesh-check " + written(folder, "rough.obj", rough)).out, "0.01 mm"));
  Mesh bowl = torus();
  std::erase_if(bowl.triangles, [&](const auto& t) { return bowl.vertices[static_cast<std::size_t>(t[0])].z() > 0; });
  const Outcome open = genu("mesh-check " + written(folder, "bowl.stl", bowl));
  EXPECT_FALSE(contains(open.out, "thickness 5/50/95")) << open.out;
  const Mesh one{{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}};
  Mesh equal = one;
  for (int k = 0; k < 500; ++k) equal.triangles.push_back({0, 1, 2});
  for (const Mesh* mesh : {&one, static_cast<const Mesh*>(&equal)}) {
    const Outcome few = genu("mesh-check " + written(folder, "few.stl", *mesh));
    EXPECT_EQ(few.exit_code, 3) << few.out;
    EXPECT_TRUE(contains(few.out, "too few to be a surface")) << few.out;
  }
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
  for (const char* name : {"mended.ply", "mended.obj"})
    EXPECT_EQ(genu("mesh-check " + dirty + " --repair " + (folder / name)).exit_code, 0) << name;
  EXPECT_EQ(read_file(folder / "mended.obj").compare(0, 8, "# genu m"), 0) << "the format is that of the ending";
  const Outcome nowhere = genu("mesh-check " + dirty + " --repair " + (folder / "no/such/folder.stl"));
  EXPECT_EQ(nowhere.exit_code, 2) << nowhere.err;
  const std::string notes = folder.write("notes.stl", "what nobody else has");
  EXPECT_EQ(genu("mesh-check " + dirty + " --repair " + notes).exit_code, 2);
  EXPECT_EQ(read_file(notes), "what nobody else has");
  EXPECT_EQ(genu("mesh-check " + dirty + " --repair " + mended).exit_code, 0) << "its own is replaced";
}

}  // namespace
}  // namespace genu::test
