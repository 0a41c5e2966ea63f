// genu mesh, run as a user runs it.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "genu/core/diagnostics.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/surface/analytic.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

const std::string kScene = R"(
format = 1
units = { length = "mm", angle = "deg" }
[body.tibia]
fixed = true
[body.femur]
[joint.knee]
type = "free"
parent = "tibia"
child = "femur"
rotations = ["flexion x", "adduction y", "rotation z"]
translations = ["x", "y", "z"]
[surface.condyle]
body = "femur"
shape = "torus"
origin = [-23, 0, 0]
x_axis = [0, 1, 0]
z_axis = [1, 0, 0]
major_radius = 15
minor_radius = 5
[surface.plateau]
body = "tibia"
shape = "plane"
[contact.medial]
surfaces = ["condyle", "plateau"]
model = "rigid"
[[step]]
prescribe = { "knee.flexion" = 0 }
increments = 1
)";

// The exit code of `genu mesh ARGUMENTS`; what it prints goes to `log`.
int run(const std::string& arguments, const std::string& log) {
  const int status = std::system((genu::test::program() + " mesh " + arguments + " > " + log + " 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(MeshCommand, WritesEachSurfaceInItsBodysFrame) {
  test::TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", kScene), log = folder / "log";
  ASSERT_EQ(run(scene + " --edge 1 --out " + (folder / "out"), log), 0) << test::read_file(log);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/plateau.stl"));
  Diagnostics problems;
  const auto mesh = read_mesh(folder / "out/condyle.stl", 1e-3, problems);
  ASSERT_TRUE(mesh);
  Pose place;
  place.R.col(0) = Vec3::UnitY();
  place.R.col(1) = Vec3::UnitZ();
  place.R.col(2) = Vec3::UnitX();
  place.p = Vec3(-0.023, 0, 0);
  const auto torus = make_torus(place, 0.015, 0.005, false);
  double worst = 0;
  for (const Vec3& v : mesh->vertices) worst = std::max(worst, std::abs(*torus->gap(v)));
  EXPECT_LT(worst, 2e-9);  // float32 at 28 mm
  const MeshReport report = check_mesh(*mesh);
  EXPECT_EQ(report.boundary_edges, 0u);
  EXPECT_NEAR(report.edge_length[2], 1e-3, 1e-4);
}

TEST(MeshCommand, ReplacesItsOwnFilesAlone) {
  test::TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", kScene), log = folder / "log",
                    command = scene + " --edge 2 --out " + folder / "";
  const std::string measured = folder.write("plateau.stl", "solid measured\nendsolid measured\n");
  EXPECT_EQ(run(command, log), 2);
  EXPECT_NE(test::read_file(log).find("plateau.stl: is there already"), std::string::npos) << test::read_file(log);
  EXPECT_EQ(test::read_file(measured), "solid measured\nendsolid measured\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "condyle.stl")) << "all or nothing";
  std::filesystem::remove(measured);
  for (const char* format : {"stl", "ply", "obj"})
    for (int twice = 0; twice < 2; ++twice)
      EXPECT_EQ(run(command + " --format " + format, log), 0) << test::read_file(log);
}

TEST(MeshCommand, MakesNoMoreTrianglesThanItSays) {
  test::TemporaryFolder folder;
  std::string scene = kScene;
  scene.replace(scene.find("shape = \"torus\""), 15, "shape = \"sphere\"\nradius = 20");
  for (const char* line : {"major_radius = 15\n", "minor_radius = 5\n"})
    scene.erase(scene.find(line), std::string(line).size());
  const std::string log = folder / "log";
  ASSERT_EQ(run(folder.write("scene.toml", scene) + " condyle --edge 0.01 --out " + (folder / "out"), log), 0)
      << test::read_file(log);
  EXPECT_NE(test::read_file(log).find("coarser than --edge 0.01"), std::string::npos) << test::read_file(log);
  EXPECT_LE(std::filesystem::file_size(folder / "out/condyle.stl"), 84 + 50 * 200'000u);
}

TEST(MeshCommand, RefusesWithExitCode2) {
  test::TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", kScene), log = folder / "log",
                    out = " --edge 1 --out " + (folder / "out");
  EXPECT_EQ(run((folder / "none.toml") + out, log), 2);
  EXPECT_EQ(run(scene + " no-such-surface" + out, log), 2);
  EXPECT_NE(test::read_file(log).find("no-such-surface"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  EXPECT_EQ(run(scene + " --edge 1 --out " + scene, log), 2) << "a file stands where the folder should";
  EXPECT_EQ(test::read_file(scene), kScene);
}

/// The bones in meshes/leskovar2019 are what their file makes, and nothing is wrong with them.
TEST(MeshCommand, MakesTheCommittedBones) {
  test::TemporaryFolder folder;
  const std::string knee = genu::test::source_folder() + "/meshes/leskovar2019/", log = folder / "log";
  ASSERT_EQ(run(knee + "bones.toml --edge 3.2 --out " + (folder / "out"), log), 0) << test::read_file(log);
  for (const char* bone : {"femur.stl", "tibia.stl", "patella.stl"}) {
    const std::string bytes = test::read_file(folder / (std::string("out/") + bone));
    EXPECT_TRUE(bytes == test::read_file(knee + bone)) << bone << " is another; run the command in bones.toml again";
    EXPECT_LT(bytes.size(), 300'000u) << bone;
    const int status = std::system((genu::test::program() + " mesh-check " + knee + bone + " > " + log).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 0) << test::read_file(log);
    EXPECT_NE(test::read_file(log).find("  volume "), std::string::npos) << "closed";
  }
}

TEST(MeshCommand, SolidsCanBeNamedAndAreRefusedWithTheirPlace) {
  test::TemporaryFolder folder;
  const std::string log = folder / "log";
  const std::string head = "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n";
  const std::string ball = "parts = [{ shape = \"sphere\", radius = 20 }]\n";
  const std::string two = folder.write("two.toml", head + "[solid.a]\n" + ball + "[solid.b]\n" + ball);
  ASSERT_EQ(run(two + " b --edge 4 --format ply --out " + (folder / "out"), log), 0) << test::read_file(log);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/b.ply"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/a.ply"));
  EXPECT_EQ(run(two + " c --edge 4 --out " + (folder / "out"), log), 2);
  EXPECT_NE(test::read_file(log).find("there is no surface \"c\"; known: a b"), std::string::npos);
  EXPECT_EQ(run(two + " --edge 0.2 --out " + (folder / "fine"), log), 2);
  EXPECT_NE(test::read_file(log).find("two.toml:3:8: solid.a: would have about"), std::string::npos)
      << test::read_file(log);
  EXPECT_FALSE(std::filesystem::exists(folder / "fine"));
  EXPECT_EQ(run(folder.write("none.toml", head) + " --edge 1 --out " + (folder / "out"), log), 2);
  EXPECT_NE(test::read_file(log).find("has no surface with a formula and no solid"), std::string::npos);
}

}  // namespace
}  // namespace genu
