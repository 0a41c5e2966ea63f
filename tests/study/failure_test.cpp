// Failures of several kinds, each saved in one file and seen again from that file alone.
#include "genu/study/failure.h"

#include <filesystem>
#include <new>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_writer.h"
#include "support/judged.h"
#include "support/meshed_scene.h"
#include "support/places.h"
#include "support/scenes.h"
#include "support/text.h"
#include "tools/cli_scenes.h"

namespace genu {
namespace {

using test::contains;
using test::read_file;
using test::with_first;

/// Runs a scene that fails and returns what was saved of it, after it has been read again.
Failure saved(const test::TemporaryFolder& folder, const std::string& scene, int code, RunOptions options = {}) {
  const std::string file = folder / "failure.json";
  options.save_failure = file;
  Diagnostics out, none;
  EXPECT_EQ(test::judged_run(scene, folder / "out", options, out, nullptr), code) << test::messages(out);
  EXPECT_TRUE(contains(test::messages(out), "holds what genu reproduce needs")) << test::messages(out);
  EXPECT_FALSE(contains(test::messages(out), "did not fail in the same way")) << test::messages(out);
  const std::string text = read_file(file);
  EXPECT_FALSE(contains(text, folder / "")) << "a folder of the user's is named";
  EXPECT_FALSE(contains(text, "secret"));
  const auto failure = read_failure(text, file, none);
  EXPECT_TRUE(failure.has_value()) << test::messages(none);
  return failure.value_or(Failure{});
}

/// In a folder of its own, where nothing of the user's is at hand.
void expect_again(const Failure& failure, const std::string& part, const RunOptions& options = {}) {
  const test::TemporaryFolder elsewhere;
  EXPECT_EQ(unpack(failure, elsewhere / ""), "");
  const std::vector<std::string> again = reproduce(failure, elsewhere / "", options);
  EXPECT_TRUE(alike(failure.verdict, again));
  ASSERT_FALSE(again.empty());
  EXPECT_TRUE(contains(again.front(), part)) << again.front();
}

std::string loose_ball() {
  std::string text = test::kBall;
  return text.erase(text.find("[ligament.front]"), text.find("[[step]]") - text.find("[ligament.front]"));
}

/// Von Mises' truss under more than it bears.
std::string truss() {
  std::string text = loose_ball();
  text.erase(text.find("[surface.ball]"), text.find("[[step]]") - text.find("[surface.ball]"));
  text = with_first(text, "z = 20", "z = 12");
  const std::string spring = "law = \"spring\"\nstiffness = 50\nreference_force = 0\n";
  const std::string between = "from = { body = \"femur\", point = [0, 0, 0] }\nto = { body = \"tibia\", point = ";
  return with_first(text.substr(0, text.find("[[step]]")), "format = 1",
                    "# from /home/secret/knees/truss.toml\nformat = 1") +
         "[ligament.l]\n" + between + "[-40, 0, 0] }\n" + spring + "[ligament.r]\n" + between + "[40, 0, 0] }\n" +
         spring +
         "[load.w]\nbody = \"femur\"\nforce = [0, 0, -30]\n[[step]]\nprescribe = { \"knee.flexion\" = 0, "
         "\"knee.adduction\" = 0, \"knee.rotation\" = 0, \"knee.x\" = 0, \"knee.y\" = 0 }\nload = { w = [0, 1] }\n"
         "increments = 50\n";
}

TEST(Failure, AFoldIsReachedFromWhereThePathRestedLast) {
  const test::TemporaryFolder folder;
  const Failure failure = saved(folder, folder.write("truss.toml", truss()), kExitIncomplete);
  EXPECT_FALSE(failure.rest.empty());
  EXPECT_EQ(failure.meshes_are, "none");
  ASSERT_EQ(failure.last_poses.size(), 3u);
  EXPECT_TRUE(contains(failure.last_poses[0], "0x1"));
  expect_again(failure, "the path turns back before this pose");
}

TEST(Failure, ADislocation) {
  const test::TemporaryFolder folder;
  const std::string scene =
      with_first(loose_ball(), "[[step]]", "[load.pull]\nbody = \"femur\"\nforce = [0, 0, 5]\n[[step]]");
  expect_again(saved(folder, folder.write("loose.toml", scene), kExitIncomplete), "no_equilibrium");
}

/// A ball that is drawn along a mesh of 60 x 16 mm, over its edge.
std::string plate_scene(const test::TemporaryFolder& folder, const std::string& mesh) {
  Mesh plate;
  for (int i = 0; i <= 60; ++i)
    for (int k = 0; k <= 16; ++k) plate.vertices.emplace_back(1e-3 * (i - 50), 1e-3 * (k - 8), 0);
  for (int i = 0; i < 60; ++i)
    for (int k = 0; k < 16; ++k) {
      const int a = 17 * i + k;
      plate.triangles.push_back({a, a + 17, a + 18});
      plate.triangles.push_back({a, a + 18, a + 1});
    }
  std::filesystem::create_directories(folder / "secret");
  EXPECT_EQ(write_ply(plate, folder / mesh, 1e-3, ""), "");
  const std::string scene =
      with_first(test::kBall, "shape = \"plane\"", "shape = \"mesh\"\nfile = \"" + mesh + "\"\nunits = \"mm\"");
  return with_first(with_first(scene, "[0, 10]", "0, \"knee.x\" = [0, 20]"), "increments = 5", "increments = 40");
}

TEST(Failure, OfContactOnAMeshTakesAPieceOfTheMeshAlong) {
  const test::TemporaryFolder folder;
  const std::string mesh = "secret/plate.ply";
  const std::string scene = folder.write("plate.toml", plate_scene(folder, mesh));
  const Failure failure = saved(folder, scene, kExitIncomplete);
  EXPECT_TRUE(contains(failure.meshes_are, "mm of contact")) << failure.meshes_are;
  ASSERT_EQ(failure.meshes.size(), 1u);
  EXPECT_LT(failure.meshes[0].second.size(), std::filesystem::file_size(folder / mesh) / 2);
  expect_again(failure, "over_edge");
}

TEST(Failure, ARefusedMeshIsTakenAlongWhole) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("plate.toml", plate_scene(folder, "secret/plate.ply"));
  folder.write("secret/plate.ply", read_file(folder / "secret/plate.ply").substr(0, 2000));
  const Failure failure = saved(folder, scene, kExitRefused);
  EXPECT_EQ(failure.meshes_are, "whole");
  expect_again(failure, "refused: ");
}

TEST(Failure, OfTheSceneItselfNeedsNoMesh) {
  const test::TemporaryFolder folder;
  const std::string text = plate_scene(folder, "secret/plate.ply");
  const Failure failure =
      saved(folder, folder.write("a.toml", with_first(text, "radius = 20", "radius = -20")), kExitRefused);
  ASSERT_EQ(failure.meshes.size(), 1u);
  EXPECT_TRUE(failure.meshes[0].second.empty());
  expect_again(failure, "radius");
}

TEST(Failure, OfAMotionThatCannotBegin) {
  const test::TemporaryFolder folder;
  const std::string file = genu::test::source_folder() + "/meshes/leskovar2019/scene.toml";
  std::string text = read_file(file);
  const auto mass = text.find("mass = ");
  text.replace(mass, text.find('\n', mass) - mass, "");
  const Failure failure = saved(folder, folder.write("motion.toml", text), kExitRefused);
  expect_again(failure, "refused: ");
}

TEST(Failure, AnExceptionIsKeptAsOne) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.progress = [](int done, int) {
    if (done >= 4) throw std::runtime_error("a bug in row 4");
  };
  const Failure failure = saved(folder, folder.write("ball.toml", test::kBall), kExitFailed, options);
  expect_again(failure, "stopped: internal error: a bug in row #", options);
}

TEST(Failure, WhatIsNoneOrChangedIsRefused) {
  const test::TemporaryFolder folder;
  const std::string text = to_json(saved(folder, folder.write("truss.toml", truss()), kExitIncomplete));
  const auto refused = [](const std::string& bytes) {
    Diagnostics out;
    return !read_failure(bytes, "failure.json", out) && out.has_errors();
  };
  EXPECT_FALSE(refused(text));
  EXPECT_TRUE(refused(""));
  EXPECT_TRUE(refused("[1, 2]"));
  EXPECT_TRUE(refused("{\"genu_failure\": 1, \"genu\": 7}"));
  EXPECT_TRUE(refused(text.substr(0, text.size() / 2)));
  EXPECT_TRUE(refused(with_first(text, "stiffness = 50", "stiffness = 51")));
}

TEST(Failure, WhatIsSealedAgainIsHeldToWhatItCanBe) {
  const test::TemporaryFolder folder;
  const Failure good = saved(folder, folder.write("truss.toml", truss()), kExitIncomplete);
  const auto refused = [](const Failure& f) {
    Diagnostics out;
    return !read_failure(to_json(f), "failure.json", out) && out.has_errors();
  };
  EXPECT_FALSE(refused(good));
  for (const std::string& name : {std::string("../a.stl"), std::string(300, 'a'), std::string("a\0b.stl", 7),
                                  std::string("scene.toml"), std::string()}) {
    Failure f = good;
    f.meshes.emplace_back(name, "bytes");
    EXPECT_TRUE(refused(f)) << name;
  }
  Failure small = good;
  small.memory_limit = 4096;
  EXPECT_TRUE(refused(small));
}

TEST(Failure, AStateOfAnotherSceneIsNotGoneOnFrom) {
  const test::TemporaryFolder folder;
  Failure f = saved(folder, folder.write("truss.toml", truss()), kExitIncomplete);
  ASSERT_FALSE(f.rest.empty());
  f.scene +=
      "[body.more]\n[joint.j2]\ntype = \"free\"\nparent = \"tibia\"\nchild = \"more\"\n"
      "rotations = [\"a x\", \"b y\", \"c z\"]\ntranslations = [\"x\", \"y\", \"z\"]\n";
  std::filesystem::create_directory(folder / "again");
  ASSERT_EQ(unpack(f, folder / "again"), "");
  EXPECT_THROW(
      {
        for (const std::string& line : reproduce(f, folder / "again", {})) ADD_FAILURE() << line;
      },
      SavedElsewhere);
}

TEST(Failure, NothingIsSavedWhereNothingFailed) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.save_failure = folder / "failure.json";
  Diagnostics out;
  EXPECT_EQ(test::judged_run(folder.write("ball.toml", test::kBall), folder / "out", options, out, nullptr), kExitOk);
  EXPECT_FALSE(std::filesystem::exists(folder / "failure.json"));
  EXPECT_TRUE(contains(test::messages(out), "nothing failed"));
}

}  // namespace
}  // namespace genu
