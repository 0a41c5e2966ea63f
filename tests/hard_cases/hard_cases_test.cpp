// Cases are laid out, run and told, the same on one thread and on many.
#include "hard_cases/hard_cases.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

const std::string kShapes =
    "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[surface.ball]\nbody = \"b\"\nshape = "
    "\"sphere\"\nradius = "
    "20\n";

const std::string kBallOnPlate = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.base]
fixed = true
[body.mover]
[joint.j]
type = "free"
parent = "base"
child = "mover"
rotations = ["rx x", "ry y", "rz z"]
translations = ["x", "y", "z"]
reference = { z = 20 }
[surface.ball]
body = "mover"
shape = "mesh"
file = "ball.stl"
units = "mm"
[surface.plate]
body = "base"
shape = "plane"
patch = { x = [-30, 30], y = [-30, 30] }
[contact.c]
surfaces = ["ball", "plate"]
model = "rigid"
[load.push]
body = "mover"
force = [0, 0, -10]
[[step]]
prescribe = { "j.rx" = 0, "j.ry" = 0, "j.rz" = 0, "j.x" = 0 }
)";

HardCase ball_on_plate(const test::TemporaryFolder& folder) {
  folder.write("shapes.toml", kShapes);
  HardCase c;
  c.family = "f";
  c.name = "ball";
  c.scene_file = folder.write("ball.toml", kBallOnPlate);
  c.expected.why = "it rolls";
  c.expected.exit_code = 3;
  c.expected.safeguard = "uniqueness";
  c.expected.statuses = {{"undetermined", 2}};
  c.expected.limit = 3600;  // a thread sanitizer takes its time
  MeshRecipe recipe;
  recipe.file = "ball.stl";
  recipe.shape = "ball";
  recipe.edge = 4e-3;
  c.expected.meshes.push_back(recipe);
  return c;
}

TEST(HardCasesRun, AreMetAndLeaveWhatTheyMade) {
  const test::TemporaryFolder folder;
  const HardCase c = ball_on_plate(folder);
  HardCaseOptions options;
  options.folder = folder / "out";
  const HardCaseOutcome met = run_hard_case(c, folder / ".", options);
  EXPECT_TRUE(met.met()) << met.misses.front();
  for (const char* file : {"scene.toml", "ball.stl", "results/results.csv", "results/summary.json"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out/f/ball/" + file)) << file;
}

TEST(HardCasesRun, AreTheSameOnAnyNumberOfThreads) {
  const test::TemporaryFolder folder;
  const std::vector<HardCase> cases(3, ball_on_plate(folder));
  const auto table = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<HardCaseOutcome> outcomes = run_hard_cases(cases, folder / ".", {});
    for (HardCaseOutcome& o : outcomes) o.seconds = 0;
    return to_text(outcomes);
  };
  EXPECT_EQ(table(1), table(2));
  EXPECT_NE(table(1).find("3 of 3 cases"), std::string::npos) << table(1);
}

TEST(HardCasesRun, WhatCannotBeLaidOutOrTakesTooLongIsMissed) {
  const test::TemporaryFolder folder;
  HardCase c = ball_on_plate(folder);
  c.expected.limit = 1e-9;
  EXPECT_FALSE(run_hard_case(c, folder / ".", {}).met());
  c = ball_on_plate(folder);
  c.expected.meshes[0].shape = "cube";
  EXPECT_NE(run_hard_case(c, folder / ".", {}).misses.at(0).find("no shape \"cube\""), std::string::npos);
  c.scene_file = folder / "none.toml";
  EXPECT_FALSE(run_hard_case(c, folder / ".", {}).met());
}

TEST(HardCasesRun, AreToldAsATable) {
  const test::TemporaryFolder folder;
  const std::string text = to_markdown({ball_on_plate(folder)});
  EXPECT_NE(text.find("| [ball](../tests/hard_cases/f/ball.toml) | it rolls | `uniqueness` |"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace genu
