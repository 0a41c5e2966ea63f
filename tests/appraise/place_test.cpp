// Where on its path a joint is, in words: what varies, else what is held.
#include "genu/appraise/place.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "support/crank_scene.h"
#include "support/scenes.h"

namespace genu {
namespace {

/// The place half way through the only step of a crank.
std::string half_way(const std::string& step, int number = 1) {
  Diagnostics out;
  const auto scene = parse_scene(test::crank_scene("[load.pull]\nbody = \"crank\"\npoint = [40, 0, 0]\n"
                                                   "force = [0, -1, 0]\n" +
                                                   step),
                                 "scene.toml", out);
  EXPECT_TRUE(scene) << test::messages(out);
  if (!scene) return {};
  const auto prepared = prepare(*scene, std::make_shared<MeshLibrary>(), out);
  EXPECT_TRUE(prepared) << test::messages(out);
  return prepared ? place(*prepared, number, prepared->steps[0].target(0.5)) : "";
}

TEST(Place, IsWhatVaries) {
  const std::string turned = "[[step]]\nprescribe = { \"hinge.angle\" = [0, 50] }\nincrements = 2\n";
  EXPECT_EQ(half_way(turned), "hinge.angle = 25 deg");
  EXPECT_EQ(half_way("[[step]]\nprescribe = { \"hinge.angle\" = 7.5 }\nload = { pull = [0, 3] }\nincrements = 2\n"),
            "load pull x 1.5");
  EXPECT_EQ(half_way("[[step]]\nprescribe = { \"hinge.angle\" = [0, 50] }\nload = { pull = [0, 3] }\nincrements = 2\n"),
            "hinge.angle = 25 deg, load pull x 1.5");
}

TEST(Place, IsWhatIsHeldWhereNothingVaries) {
  EXPECT_EQ(half_way("[[step]]\nprescribe = { \"hinge.angle\" = 7.5 }\nincrements = 1\n"), "hinge.angle = 7.5 deg");
}

TEST(Place, BeforeTheFirstStepIsTheApproach) {
  EXPECT_EQ(half_way("[[step]]\nprescribe = { \"hinge.angle\" = [10, 50] }\nincrements = 2\n", 0),
            "the approach to a step's start, with hinge.angle = 30 deg");
}

}  // namespace
}  // namespace genu
