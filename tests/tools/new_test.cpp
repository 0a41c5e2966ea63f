// genu new: what it writes runs, and from two meshes that genu mesh has written the way leads to a report.
#include <filesystem>

#include <gtest/gtest.h>

#include "support/places.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

TEST(CliNew, EveryKindRunsAsWritten) {
  const TemporaryFolder folder;
  const std::string bones = genu::test::source_folder() + "/meshes/leskovar2019/bones.toml";
  ASSERT_EQ(genu("mesh " + bones + " femur tibia --edge 4 --out " + (folder / "stl")).exit_code, 0);
  const std::string meshes = " --femur " + (folder / "stl/femur.stl") + " --tibia " + (folder / "stl/tibia.stl");
  for (const std::string& kind :
       {std::string(), std::string(" --kind analytic"), std::string(" --kind motion"), meshes}) {
    const TemporaryFolder own;
    const Outcome made = genu("new " + (own / "knee") + kind);
    EXPECT_EQ(made.exit_code, 0) << made.out << made.err;
    const std::string scene = own / "knee/knee.toml";
    EXPECT_TRUE(contains(made.out, "genu run " + scene)) << made.out;
    EXPECT_EQ(genu("check " + scene).exit_code, 0) << kind;
    const Outcome run = genu("run " + scene + " --out " + (own / "out"));
    EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.out << run.err;  // coarse bones may snap
    EXPECT_EQ(run.err.find("warning"), std::string::npos) << run.err;
    EXPECT_TRUE(std::filesystem::exists(own / "out/report.html")) << kind;
    const std::string before = read_file(scene);
    EXPECT_EQ(genu("new " + (own / "knee") + kind).exit_code, 2);
    EXPECT_EQ(read_file(scene), before);
  }
}

TEST(CliNew, SaysWhichMeshesItNeeds) {
  const TemporaryFolder folder;
  const Outcome refused = genu("new " + (folder / "knee") + " --kind stl");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "--femur femur.stl --tibia tibia.stl")) << refused.err;
  for (const char* option : {" --side left", " --femur '' --tibia ''", " --kind analytic --proximal z"}) {
    const Outcome more = genu("new " + (folder / "knee") + option);
    EXPECT_EQ(more.exit_code, 2) << option;
    EXPECT_FALSE(contains(more.err, "internal")) << more.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "knee"));
}

TEST(CliNew, RefusesMeshesThatAreNoKnee) {
  const TemporaryFolder folder;
  const std::string at = genu::test::source_folder() + "/meshes/leskovar2019/", femur = at + "femur.stl",
                    tibia = at + "tibia.stl";
  for (const auto& [meshes, told] :
       {std::pair("--femur " + femur + " --tibia " + femur, "are the same mesh"),
        std::pair("--femur " + tibia + " --tibia " + femur + " --proximal y", "swapped"),
        std::pair("--femur " + femur + " --tibia " + tibia + " --units m", "write units"),
        std::pair("--femur " + femur + " --tibia " + (folder / "'\xff'.stl"), "UTF-8 text")}) {
    const Outcome refused = genu("new " + (folder / "knee") + " " + meshes);
    EXPECT_EQ(refused.exit_code, 2) << refused.out;
    EXPECT_TRUE(contains(refused.err, told)) << refused.err;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder / "."));
}

/// The line it ends with is a command that a shell takes, however the folder is called.
TEST(CliNew, WhatItSaysComesNextRuns) {
  const TemporaryFolder folder;
  const std::string name = folder / "my knee's #1";
  const Outcome made = genu("new '" + (folder / "my knee'\\''s #1") + "'");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(std::filesystem::exists(name + "/my knee's #1.toml"));
  EXPECT_TRUE(contains(made.out, "--out 'out/my knee'\\''s #1'")) << made.out;
}

}  // namespace
}  // namespace genu::test
