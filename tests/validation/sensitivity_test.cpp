// Derivatives of every kind of output to every kind of parameter against the scene edited and solved again: central
// differences of the edited scene, extrapolated.
#include <string>

#include <gtest/gtest.h>

#include "genu/mesh_files/stl_writer.h"
#include "genu/surface/analytic.h"
#include "support/knee_scene.h"
#include "support/scene_model.h"
#include "support/temporary_folder.h"
#include "validation/sensitivity_case.h"

namespace genu::test {
namespace {

std::string flexed(double from, double to, int increments) {
  return "[[step]]\nprescribe = { \"knee.flexion\" = [" + std::to_string(from) + ", " + std::to_string(to) +
         "] }\nincrements = " + std::to_string(increments) + "\n";
}

TEST(Sensitivity, OfTheTorusKneeIsWhatSolvingTheEditedSceneGives) {
  compare("torus knee", knee(flexed(10, 60, 5)), {0, 2, 5});
}

TEST(Sensitivity, OfTheKneeAsCliniciansDescribeIt) {
  std::string text = knee(flexed(10, 60, 5));
  const std::string translations = "translations = [\"x\", \"y\", \"z\"]\n";
  ASSERT_NE(text.find(translations), std::string::npos);
  text.insert(
      text.find(translations) + translations.size(),
      "grood_suntay = { side = \"left\", femur = { body = \"bone\", proximal = \"z\", anterior = \"y\", origin = "
      "[1, 2, 3] }, tibia = { body = \"ground\", proximal = \"z\", anterior = \"y\" } }\n");
  compare("clinical motion", text, {1, 4}, {{"*.gs.*"}, {"all"}});
}

TEST(Sensitivity, OfLoadsOfEveryKind) {
  const std::string loads =
      load("push", "force = [3, -10, -20]\nmoment = [0.05, 0.02, 0.01]\npoint = [3, 4, 10]") +
      load("follow", "force = [2, 5, -30]\nmoment = [0.02, 0.03, -0.01]\npoint = [-5, 2, 8]\nframe = \"body\"") +
      load("pull",
           "point = [1, 2, 30]\ntoward = { body = \"ground\", point = [5, 40, -60] }\nmagnitude = 15\n"
           "scale = { over = \"knee.flexion\", table = [[0, 0.5], [40, 1], [90, 2]] }") +
      "[load.turn]\non = \"knee.rotation\"\nvalue = 0.1\n";
  const std::string step =
      "[[step]]\nprescribe = { \"knee.flexion\" = [11, 51] }\nload = { push = [0.5, 1] }\nincrements = 4\n";
  compare("loads", knee(loads + step), {0, 3});
}

TEST(Sensitivity, OfTheTorusKneeMeshed) {
  const TemporaryFolder folder;
  const std::string file = folder / "torus.stl";
  const auto torus = make_torus(Pose(), 15e-3, 5e-3, false);
  ASSERT_EQ(write_stl(torus->triangles(1e-3, Vec3::Zero(), 1), file, 1e-3, "torus"), "");
  std::string text = knee(flexed(10, 50, 4));
  text = replaced(text, "shape = \"torus\"", "shape = \"mesh\"");
  text = replaced(text, "major_radius = 15\nminor_radius = 5", "file = \"" + file + "\"\nunits = \"mm\"");
  compare("meshed torus knee", text, {1, 4});
}

TEST(Sensitivity, OfAMeasuredKnee) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  compare("measured knee", lenhart_scene("", 0, 60, 6), {1, 3, 6},
          {{"knee.*", "tibiofemoral.*", "ACLpl1.*", "MCLs3.force"},
           {"*.offset", "*.origin.?", "ACLpl1.*", "MCLs3.*", "compression.force.?", "compression.factor", "knee.*"}},
          0.001);
}

}  // namespace
}  // namespace genu::test
