// A ball pressed into a layer by more than the layer carries.
#include <gtest/gtest.h>

#include "support/judged.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

/// A ball of 20 mm on 4 mm of 5 MPa between triangles or smooth surfaces: rays end 4 mm deep.
std::string pressed_ball(const std::string& force, const std::string& quadrature) {
  return test::bone_on_ground("{ z = 19.5 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
         test::surface("floor", "ground", "plane") + test::layer("foot", "ball", "floor", quadrature) +
         test::load("press", "force = [0, 0, -" + force + "]") +
         test::step("prescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0, \"j.x\" = 0, \"j.y\" = 0 }\nincrements = 1");
}

TEST(Overload, IsToldFromAStartTooFarAway) {
  for (const std::string quadrature : {"", "quadrature = \"triangles\"\ncast_from = \"ball\""}) {
    const test::TemporaryFolder folder;
    Diagnostics out;
    Solution solution;
    const std::string scene = folder.write("scene.toml", pressed_ball("10000", quadrature));
    EXPECT_EQ(test::judged_run(scene, folder / "out", {}, out, &solution), kExitIncomplete) << test::messages(out);
    ASSERT_EQ(solution.summary.poses_solved, 0);
    // From pi K d^2 (R - d / 6), d = 4 mm, the layer carries 2.6 kN at most.
    EXPECT_GT(solution.summary.bearable_loads, 0.2) << quadrature;
    EXPECT_LT(solution.summary.bearable_loads, 0.28) << quadrature;
    std::string said;
    for (const std::string& sentence : solution.summary.verdict) said += sentence + "\n";
    EXPECT_NE(said.find("The joint balances here under 0.2"), std::string::npos) << said;
    EXPECT_EQ(said.find("Start nearer"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace genu
