// What `genu new` writes runs as it is written, and holds what was asked for.
#include "genu/new_scene/new_scene.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "genu/study/knee_layout.h"
#include "genu/study/run_scene.h"
#include "support/data.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

using test::contains;
using test::data_path;
using test::read_file;
using test::TemporaryFolder;

const std::string kBones = genu::test::source_folder() + "/meshes/leskovar2019/";

/// Writes it, checks it as `genu check` does, and runs it as a user would.
Solution written_and_run(const NewScene& asked, const TemporaryFolder& folder) {
  Diagnostics out;
  const auto report = write_new_scene(asked, out);
  EXPECT_TRUE(report.has_value()) << (out.items().empty() ? "" : to_string(out.items().front()));
  Solution found;
  if (!report) return found;
  EXPECT_EQ(report->poses_solved, report->poses_asked);
  EXPECT_TRUE(report->verdict.empty());
  Diagnostics said;
  EXPECT_EQ(run_scene(report->file, folder / "out", {}, said, &found), kExitOk);
  EXPECT_TRUE(said.items().empty()) << to_string(said.items().front());
  EXPECT_EQ(found.summary.poses_solved, report->poses_solved);
  return found;
}

TEST(NewScene, OfFormulasRuns) {
  const TemporaryFolder folder;
  const Solution found = written_and_run({.folder = folder / "knee"}, folder);
  EXPECT_EQ(found.summary.poses_stable, 31);
  const std::string text = read_file(folder / "knee/knee.toml");
  EXPECT_FALSE(contains(text, "@"));
  EXPECT_TRUE(contains(text, "title = \"knee\""));
}

TEST(NewScene, OfMotionRuns) {
  const TemporaryFolder folder;
  const Solution found = written_and_run({.kind = NewScene::Kind::motion, .folder = folder / "shank"}, folder);
  ASSERT_EQ(found.poses.rows(), 251u);
  EXPECT_NEAR(found.poses.number(0, "knee.angle_deg"), 80, 1e-9);  // let go there, it falls
  EXPECT_LT(found.poses.number(20, "knee.angle_deg"), 79);
}

TEST(NewScene, OfTwoMeshesRunsAndPressesAsItSays) {
  const TemporaryFolder folder;
  const NewScene asked{.kind = NewScene::Kind::stl,
                       .folder = folder / "knee",
                       .femur = kBones + "femur.stl",
                       .tibia = kBones + "tibia.stl"};
  const Solution found = written_and_run(asked, folder);
  EXPECT_EQ(found.summary.poses_stable, 130);
  ASSERT_EQ(found.poses.rows(), 130u);
  EXPECT_NEAR(found.poses.number(129, "knee.flexion_deg"), 120, 1e-9);
  EXPECT_GT(found.poses.number(129, "tibiofemoral.force_N"), 100);  // the load and the ligaments' pull
  EXPECT_NEAR(found.poses.number(129, "knee.gs.flexion_deg"), 120, 5);
  const std::string text = read_file(folder / "knee/knee.toml");
  EXPECT_FALSE(contains(text, "@"));
  for (const char* said : {"femur.stl", "tibia.stl", "CHOSEN", "GUESSED", "regions = { medial = \"z < "})
    EXPECT_TRUE(contains(text, said)) << said;
}

/// A left knee is the right one seen in a mirror: the lateral side changes, the mechanics do not.
TEST(NewScene, OfALeftKnee) {
  const TemporaryFolder folder;
  const NewScene asked{.kind = NewScene::Kind::stl,
                       .folder = folder / "left",
                       .femur = kBones + "femur.stl",
                       .tibia = kBones + "tibia.stl",
                       .unit = "mm",
                       .proximal = "y",
                       .anterior = "x",
                       .left = true};
  written_and_run(asked, folder);
  const std::string text = read_file(folder / "left/left.toml");
  EXPECT_TRUE(contains(text, "side = \"left\""));
  EXPECT_TRUE(contains(text, "medial = \"z >= "));
  EXPECT_FALSE(contains(text, "GUESSED from its size"));
}

TEST(NewScene, ReplacesNothingAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "knee");
  const auto refused = [&](const NewScene& asked, const std::string& said) {
    Diagnostics out;
    EXPECT_FALSE(write_new_scene(asked, out).has_value());
    ASSERT_FALSE(out.items().empty());
    EXPECT_TRUE(contains(to_string(out.items().front()), said)) << to_string(out.items().front());
  };
  refused({.folder = folder / "knee"}, "exists already");
  refused({.folder = folder / "knee/"}, "exists already");
  refused({.kind = NewScene::Kind::stl, .folder = folder / "a"}, "--femur femur.stl --tibia tibia.stl");
  refused({.kind = NewScene::Kind::motion, .folder = folder / "a", .femur = "f.stl"}, "--kind");
  refused({.kind = NewScene::Kind::stl, .folder = folder / "a", .femur = "none.stl", .tibia = "none.stl"}, "none.stl");
  const std::string femur = kBones + "femur.stl", tibia = kBones + "tibia.stl";
  refused({.kind = NewScene::Kind::stl, .folder = folder / "a", .femur = femur, .tibia = tibia, .anterior = "front"},
          "must be one of x");
  refused({.kind = NewScene::Kind::stl,
           .folder = folder / "a",
           .femur = femur,
           .tibia = tibia,
           .proximal = "y",
           .anterior = "y"},
          "different axes");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / ""), {}), 1);
}

/// Names that TOML would stumble over.
TEST(NewScene, OfAnOddName) {
  const TemporaryFolder folder;
  Diagnostics out;
  const auto report = write_new_scene({.folder = folder / "my \"first\" knee"}, out);
  ASSERT_TRUE(report.has_value());
  const auto scene = read_scene(report->file, out);
  ASSERT_TRUE(scene.has_value());
  EXPECT_EQ(scene->title, "my \"first\" knee");
}

/// Cartilage and bones of measured knees, in their own frames and units.
TEST(NewScene, OfMeasuredKnees) {
  GENU_NEEDS_DATA("ssm/S002_Tibia_Cartilage.ply");
  const std::pair<std::string, std::string> meshes[] = {
      {"lenhart2015/ACLC01-R-femur-cart-coarse.stl", "lenhart2015/ACLC01-R-tibia-cart-coarse.stl"},
      {"lenhart2015/lenhart2015-R-femur-subchondral-bone.stl", "lenhart2015/lenhart2015-R-tibia-subchondral-bone.stl"},
      {"ssm/S001_Femur.ply", "ssm/S001_Tibia.ply"},
      {"ssm/S002_Femur_Cartilage.ply", "ssm/S002_Tibia_Cartilage.ply"}};
  for (const auto& [femur, tibia] : meshes) {
    const TemporaryFolder folder;
    Diagnostics out;
    const auto report = write_new_scene(
        {.kind = NewScene::Kind::stl, .folder = folder / "knee", .femur = data_path(femur), .tibia = data_path(tibia)},
        out);
    ASSERT_TRUE(report.has_value()) << femur;
    EXPECT_EQ(report->poses_solved, 130) << femur;
  }
}

}  // namespace
}  // namespace genu
