// A ball on a string above a plate, and one that rests on it.
#include "genu/appraise/untouched.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "genu/appraise/appraise.h"
#include "support/places.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

using ::testing::HasSubstr;

constexpr const char* kKnee =
    "grood_suntay = { side = \"right\", femur = { body = \"bone\", proximal = \"z\", anterior = \"x\" }, tibia = { "
    "body = "
    "\"ground\", proximal = \"z\", anterior = \"x\" } }\n";

/// A ball of 20 mm whose middle the load alone would hang 20 mm below the hook (mm above the plate).
struct Ball {
  std::optional<Prepared> prepared;
  Solution found;

  explicit Ball(double hook, const std::string& of_joint = "") {
    std::string text = test::bone_on_ground("{ z = 21 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                       test::surface("plate", "ground", "plane", "patch = { x = [-9, 9], y = [-9, 9] }") +
                       test::layer("foot", "ball", "plate", "quadrature = \"smooth\"") +
                       test::ligament("string", "[0, 0, 0]", "[0, 0, " + std::to_string(hook) + "]",
                                      "law = \"spring\"\nstiffness = 60\nslack_length = 19") +
                       test::load("down", "force = [0, 0, -60]") +
                       test::step("prescribe = { \"j.x\" = 0, \"j.y\" = 0, \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0 }");
    text.insert(text.find("child = \"bone\""), of_joint);
    Diagnostics out;
    const auto scene = parse_scene(text, "scene.toml", out);
    EXPECT_TRUE(scene) << test::messages(out);
    if (scene) prepared = prepare(*scene, std::make_shared<MeshLibrary>(), out);
    EXPECT_TRUE(prepared) << test::messages(out);
    if (!prepared) return;
    ContactField field(prepared->model);
    found = solve(*prepared, field, {});
  }
  std::vector<std::string> sentences() const { return untouched_sentences(*prepared, found.records, found.poses); }
};

TEST(Untouched, IsSaidAndIsADoubtInAKneeAlone) {
  Ball above(45);
  ASSERT_EQ(above.sentences().size(), 1U);
  EXPECT_THAT(above.sentences()[0], HasSubstr("no contact bears any load at any pose"));
  EXPECT_FALSE(needs_contact(*above.prepared));
  EXPECT_EQ(above.found.summary.exit_code, kExitOk);
  EXPECT_THAT(above.found.summary.verdict.back(), HasSubstr("No contact bears any load"));

  const Ball knee(45, kKnee);
  EXPECT_TRUE(needs_contact(*knee.prepared));
  EXPECT_EQ(knee.found.summary.exit_code, kExitDoubtful);
  EXPECT_THAT(knee.found.summary.verdict[0], HasSubstr("Solved, but no contact bears any load"));
}

TEST(Untouched, NotWhereSomethingPressesOrNothingIsSolved) {
  Ball pressed(39);
  EXPECT_TRUE(pressed.sentences().empty());
  Ball above(45);
  above.found.records.clear();
  EXPECT_TRUE(above.sentences().empty());
}

}  // namespace
}  // namespace genu
