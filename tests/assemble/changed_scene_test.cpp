#include "genu/assemble/changed_scene.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"
#include "tools/cli_scenes.h"

namespace genu {
namespace {

/// kBall with a bundle, a load and a cartilage beside the rigid contact that is switched off.
std::string scene_text() {
  std::string text = test::kBall;
  text.insert(text.find("[[step]]"), R"([ligament.extra]
from = { body = "femur", point = [0, 20, 0] }
to = { body = "tibia", point = [5, 30, -20] }
law = "quadratic"
stiffness = 100
reference_strain = 0.05
[bundle.sides]
fibres = ["side", "far"]
[load.push]
body = "femur"
force = [0, 0, -10]
[contact.soft]
surfaces = ["ball", "plate"]
model = "cartilage"
modulus = 5
poisson = 0.4
thickness = 4
enabled = false
)");
  return text;
}

class ChangedScene : public testing::Test {
 protected:
  std::optional<Scene> read(const SceneChanges& changes) {
    out_ = {};
    return read_changed_scene({folder_.write("ball.toml", scene_text()), changes}, out_);
  }
  std::string refused(const SceneChanges& changes) {
    EXPECT_FALSE(read(changes));
    return test::messages(out_);
  }
  static bool has(const Scene& scene, const std::string& ligament) {
    return std::any_of(scene.ligaments.begin(), scene.ligaments.end(),
                       [&](const LigamentDef& l) { return l.name == ligament; });
  }

  test::TemporaryFolder folder_;
  Diagnostics out_;
};

TEST_F(ChangedScene, WithoutChangesItIsTheFile) {
  const auto scene = read({});
  ASSERT_TRUE(scene) << test::messages(out_);
  EXPECT_EQ(scene->ligaments.size(), 5u);
  EXPECT_EQ(scene->title, "ball on a plate");
  EXPECT_TRUE(scene->layers.empty()) << "enabled = false";
  ASSERT_EQ(scene->disabled.size(), 1u);
  EXPECT_EQ(scene->disabled[0].name, "soft");
}

TEST_F(ChangedScene, NamesPatternsAndBundlesAreLeftOut) {
  const auto front = read({{"fr*"}, {}});
  ASSERT_TRUE(front) << test::messages(out_);
  EXPECT_FALSE(has(*front, "front"));
  EXPECT_EQ(front->ligaments.size(), 4u);
  EXPECT_EQ(front->title, "ball on a plate (without fr*)");
  const auto sides = read({{"sides"}, {}});
  ASSERT_TRUE(sides) << test::messages(out_);
  EXPECT_TRUE(has(*sides, "front") && has(*sides, "back") && !has(*sides, "side") && !has(*sides, "far"));
  EXPECT_TRUE(sides->bundles.at(0).members.empty());
  const auto others = read({{"load.push", "contact.medial"}, {}});
  ASSERT_TRUE(others) << test::messages(out_);
  EXPECT_TRUE(others->loads.empty() && others->contacts.empty());
  EXPECT_EQ(others->ligaments.size(), 5u);
}

TEST_F(ChangedScene, NumbersFactorsAndDifferencesAreSet) {
  const auto scene =
      read({{}, {"front.stiffness=15000", "sides.stiffness=x0.5", "push.force.z=+4", "ball.radius=19.5"}});
  ASSERT_TRUE(scene) << test::messages(out_);
  EXPECT_EQ(scene->ligaments[0].number("stiffness"), 15000);
  EXPECT_EQ(scene->ligaments[1].number("stiffness"), 20000);
  EXPECT_EQ(scene->ligaments[2].number("stiffness"), 10000);
  EXPECT_EQ(scene->ligaments[3].number("stiffness"), 10000);
  EXPECT_EQ(scene->loads[0].force.z(), -6);
  EXPECT_NEAR(scene->surfaces[0].radius, 19.5e-3, 1e-15);
  EXPECT_EQ(scene->changed.words.size(), 4u);
  EXPECT_EQ(scene->changed.words[1], "sides.stiffness=x0.5 (2 numbers of 2 ligaments)");
}

TEST_F(ChangedScene, APatternSaysWhatItChangesAndWhatItLeaves) {
  const auto words = [&](const std::string& option) {
    const auto scene = read({{}, {option}});
    EXPECT_TRUE(scene) << test::messages(out_);
    return scene ? scene->changed.words.at(0) : std::string();
  };
  EXPECT_EQ(words("front.stiffness=15000"), "front.stiffness 20000 -> 15000");
  EXPECT_EQ(words("fron*.stiffness=15000"), "fron*.stiffness=15000 (front.stiffness 20000 -> 15000)");
  EXPECT_EQ(words("*.from.x=+1"), "*.from.x=+1 (5 numbers of 5 ligaments)");
  EXPECT_EQ(
      words("push.*=x2"),
      "push.*=x2 (3 numbers of 1 load); not given in the file, and left: load.push.moment[1], load.push.moment[2], "
      "load.push.moment[3] and 3 more; not to be set: push.factor");
}

TEST_F(ChangedScene, TheKindMayStandInFrontOfEveryName) {
  const auto scene = read({{},
                           {"ligament.front.stiffness=15000", "load.push.force.z=-7", "surface.ball.radius=19.5",
                            "ligament.sides.stiffness=x2"}});
  ASSERT_TRUE(scene) << test::messages(out_);
  EXPECT_EQ(scene->ligaments[0].number("stiffness"), 15000);
  EXPECT_EQ(scene->ligaments[2].number("stiffness"), 40000);
  EXPECT_EQ(scene->loads[0].force.z(), -7);
  EXPECT_NEAR(scene->surfaces[0].radius, 19.5e-3, 1e-15);
  EXPECT_TRUE(test::contains(refused({{}, {"surface.front.stiffness=1"}}), "is no number"));
}

TEST_F(ChangedScene, ThePointOfACableCannotBeSet) {
  const std::string cable = scene_text() +
                            "[load.muscle]\nfrom = { body = \"femur\", point = [0, 0, 40] }\nto = { body = "
                            "\"tibia\", point = [0, 0, -40] }\nmagnitude = 10\n";
  EXPECT_FALSE(read_changed_scene({folder_.write("cable.toml", cable), {{}, {"muscle.from.x=1"}}}, out_));
  EXPECT_TRUE(test::contains(test::messages(out_), "cannot be set (muscle.from.x)")) << test::messages(out_);
}

TEST_F(ChangedScene, TheLastChangeOfANumberHolds) {
  const auto scene = read({{}, {"*.stiffness=x2", "back.stiffness=x3"}});
  ASSERT_TRUE(scene) << test::messages(out_);
  EXPECT_EQ(scene->ligaments[0].number("stiffness"), 40000);
  EXPECT_EQ(scene->ligaments[1].number("stiffness"), 120000);
}

TEST_F(ChangedScene, TheWrittenTextIsTheChangedScene) {
  const auto scene = read({{"side", "soft"}, {"front.stiffness=15000", "front.stiffness=x2", "push.force.z=-7"}});
  ASSERT_TRUE(scene) << test::messages(out_);
  const std::string text = with_changes(scene_text(), *scene, out_);
  const auto again = parse_scene(text, folder_ / "again.toml", out_);
  ASSERT_TRUE(again) << test::messages(out_) << text;
  EXPECT_EQ(again->ligaments.size(), 4u);
  EXPECT_EQ(again->ligaments[0].number("stiffness"), 30000);
  EXPECT_EQ(again->loads[0].force.z(), -7);
  EXPECT_EQ(again->disabled.size(), 2u);
}

TEST_F(ChangedScene, WhatTwoNamesLeaveOutIsWrittenOnce) {
  for (const SceneChanges& changes : {SceneChanges{{"side", "si*", "sides"}, {}}, SceneChanges{{"sides", "s*"}, {}}}) {
    const auto scene = read(changes);
    ASSERT_TRUE(scene) << test::messages(out_);
    const std::string text = with_changes(scene_text(), *scene, out_);
    const auto again = parse_scene(text, folder_ / "again.toml", out_);
    ASSERT_TRUE(again) << test::messages(out_) << text;
    EXPECT_EQ(again->ligaments.size(), 3u);
    EXPECT_EQ(again->disabled.size(), 3u) << "side, far and the cartilage that the file leaves out";
  }
}

TEST_F(ChangedScene, AnUnknownNameIsRefusedWithANearOne) {
  EXPECT_TRUE(test::contains(refused({{"frnt"}, {}}), "did you mean \"front\"?")) << test::messages(out_);
  EXPECT_TRUE(test::contains(refused({{}, {"front.stifness=1"}}), "did you mean \"front.stiffness\"?"))
      << test::messages(out_);
  EXPECT_TRUE(test::contains(refused({{""}, {}}), "is no ligament"));
}

TEST_F(ChangedScene, AValueThatIsNoneIsRefused) {
  for (const char* option : {"front.stiffness", "front.stiffness=", "front.stiffness=x", "front.stiffness=nan",
                             "front.stiffness=1e999", "front.stiffness=2 N", "=2"})
    EXPECT_TRUE(test::contains(refused({{}, {option}}), "NAME=VALUE")) << option;
  EXPECT_TRUE(test::contains(refused({{}, {"knee.flexion=3"}}), "cannot be set"));
  EXPECT_TRUE(test::contains(refused({{}, {"push.moment.x=3"}}), "is not given in the file"));
}

TEST_F(ChangedScene, AChangedNumberObeysTheRulesOfAWrittenOne) {
  const std::string said = refused({{}, {"front.stiffness=-2"}});
  EXPECT_TRUE(test::contains(said, "ligament.front.stiffness = -2.0: must be > 0")) << said;
  EXPECT_TRUE(test::contains(said, "ball.toml:")) << said;
}

TEST_F(ChangedScene, AResultNamesItsChangesAndIsJudgedWithThem) {
  const std::string scene = folder_.write("ball.toml", scene_text()), out = folder_ / "out";
  ASSERT_EQ(test::genu("run " + scene + " --without extra --set 'push.force.z=x2' --out " + out).exit_code, 0);
  EXPECT_TRUE(test::contains(test::read_file(out + "/summary.json"), "\"changes\""));
  EXPECT_TRUE(test::contains(test::read_file(out + "/report.html"), "without extra"));
  EXPECT_TRUE(test::contains(test::read_file(out + "/results.csv"), "sides.force_N"));
  EXPECT_EQ(test::genu("judge " + out).exit_code, 0);
  const std::string beside = folder_ / "intact";
  const test::Outcome both = test::genu("run " + scene + " --without extra --beside " + beside + " --out " + out);
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_TRUE(std::filesystem::exists(out + ".compared.html"));
  EXPECT_EQ(test::genu("run " + scene + " --beside " + beside + " --out " + out).exit_code, 2);
}

TEST_F(ChangedScene, RowsOfOtherChangesAreNotContinued) {
  const std::string text = test::with_first(scene_text(), "increments = 5", "increments = 100");
  const std::string scene = folder_.write("ball.toml", text), out = folder_ / "out";
  RunOptions options;
  options.checkpoint_seconds = 0;
  int rows = 0;
  options.progress = [&](int done, int) { rows = done; };
  options.cancelled = [&] { return rows >= 50; };
  Diagnostics said;
  ASSERT_EQ(run_scene({scene, {{"extra"}, {}}}, out, options, said, nullptr), kExitIncomplete);
  options.cancelled = {};
  options.resume = true;
  Diagnostics other, none;
  EXPECT_EQ(run_scene({scene, {{}, {"push.force.z=-9"}}}, out, options, other, nullptr), kExitRefused);
  EXPECT_EQ(run_scene(scene, out, options, none, nullptr), kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(none), "what --without and --set change: has changed since"))
      << test::messages(none);
  EXPECT_EQ(run_scene({scene, {{"extra"}, {}}}, out, options, said, nullptr), kExitOk) << test::messages(said);
}

}  // namespace
}  // namespace genu
