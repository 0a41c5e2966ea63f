// What a run keeps of the warnings about its scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "genu/core/file_text.h"
#include "genu/study/run_scene.h"
#include "support/places.h"
#include "support/scene_model.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// summary.json of a ball on a plate.
std::string summary_of(const std::string& modulus) {
  const test::TemporaryFolder folder;
  std::string foot = test::layer("foot", "ball", "plate", "quadrature = \"smooth\"");
  foot.replace(foot.find("modulus = 5"), 11, "modulus = " + modulus);
  const std::string scene = folder.write(
      "scene.toml", test::bone_on_ground("{ z = 19.9 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                        test::surface("plate", "ground", "plane", "patch = { x = [-9, 9], y = [-9, 9] }") + foot +
                        test::load("down", "force = [0, 0, -60]") +
                        test::step("prescribe = { \"j.x\" = 0, \"j.y\" = 0, \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0 }"));
  RunOptions options;
  options.report = false;
  Diagnostics out;
  Solution found;
  (void)run_scene({scene, {}}, folder / "out", options, out, &found);
  EXPECT_FALSE(out.has_errors());
  return text_of_file(folder / "out/summary.json", out).value_or("");
}

TEST(WholeRun, TheVerdictNamesWhatTheSceneWasWarnedOf) {
  EXPECT_THAT(summary_of("1e6"), HasSubstr("The scene has 1 warning (contact.foot.modulus): `genu check` says"));
  EXPECT_THAT(summary_of("10"), AllOf(HasSubstr("Every pose is solved"), Not(HasSubstr("The scene has"))));
}

}  // namespace
}  // namespace genu
