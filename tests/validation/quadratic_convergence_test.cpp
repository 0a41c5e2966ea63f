// Newton converges quadratically on smooth scenes: the last three residuals of every pose say so.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/knee_scene.h"
#include "support/scenes.h"

namespace genu {
namespace {

// r' <= K r^2 of successive scaled residuals, beside the rounding of forces of some 100 N (3e-13 is seen). K is the
// worst of these scenes with room to spare. A Jacobian that is wrong anywhere converges linearly: it comes to the
// tolerance of 1e-12 from some 1e-11, whose square is nothing.
constexpr double kCurvature = 2e3, kRounding = 1e-12;
// A last step with the Jacobian of the one before shrinks the residual as much as that one did, but for this.
constexpr double kAgain = 4;

struct WorstRatio {
  int examined = 0;
  double ratio = 0;  ///< (r' - rounding) / r^2
};

WorstRatio examine(const Solution& solution) {
  WorstRatio worst;
  for (const PoseRecord& r : solution.records) {
    const NewtonReport& newton = r.point.report.newton;
    EXPECT_TRUE(r.point.solved()) << r.point.increment;
    const double r0 = newton.residual_history[0], r1 = newton.residual_history[1], r2 = newton.residual_history[2];
    if (!(r0 > 0) || !(r1 > 0)) continue;  // fewer iterations than that
    ++worst.examined;
    EXPECT_LT(r2, std::max(r1, kRounding));
    if (!newton.simplified_history[1]) worst.ratio = std::max(worst.ratio, (r1 - kRounding) / (r0 * r0));
    if (newton.simplified_history[2])
      EXPECT_LT(r2, kAgain * r1 * r1 / r0 + kRounding) << r.point.increment;
    else
      worst.ratio = std::max(worst.ratio, (r2 - kRounding) / (r1 * r1));
  }
  return worst;
}

void expect_quadratic(const std::string& name, const Scene& scene, int at_least) {
  const WorstRatio worst = examine(test::solved(scene));
  std::printf("%-24s %3d poses, largest r' / r^2 %.2g\n", name.c_str(), worst.examined, worst.ratio);
  EXPECT_GE(worst.examined, at_least) << name;
  EXPECT_LT(worst.ratio, kCurvature) << name;
}

Scene scene_of(const std::string& text) {
  Diagnostics out;
  auto scene = parse_scene(text, "scene.toml", out);
  EXPECT_TRUE(scene.has_value()) << test::messages(out);
  return scene ? *scene : Scene{};
}

TEST(QuadraticConvergence, TorusKnee) {
  Diagnostics out;
  Scene scene = *read_scene(test::dortmans_file(), out);
  for (const int increments : {7, 14, 70}) {
    scene.steps[0].increments = increments;
    expect_quadratic(fmt::format("torus knee, {} steps", increments), scene, increments == 70 ? 30 : increments);
  }
}

TEST(QuadraticConvergence, PolynomialBowlsFollowersAndCombinations) {
  const std::string text = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.bone]
[joint.j]
type = "free"
parent = "ground"
child = "bone"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { z = 12.5 }
[surface.head]
body = "bone"
shape = "ellipsoid"
radii = [14, 11, 12]
[surface.bowl]
body = "ground"
shape = "polynomial"
terms = [[2, 0, 0.01], [0, 2, 0.015], [1, 1, 0.003], [3, 0, 0.00005]]
[contact.c]
surfaces = ["head", "bowl"]
model = "rigid"
[ligament.l]
from = { body = "bone", point = [12, 0, 4] }
to = { body = "ground", point = [20, 5, -20] }
law = "blankevoort"
stiffness = 2000
transition_strain = 0.06
reference_strain = 0.03
[ligament.r]
from = { body = "bone", point = [-12, 0, 4] }
to = { body = "ground", point = [-20, -5, -20] }
law = "quadratic"
stiffness = 4000
reference_strain = 0.04
[ligament.t]
from = { body = "bone", point = [0, 10, 2] }
to = { body = "ground", point = [0, 25, -15] }
law = "spring"
stiffness = 20
reference_force = 10
[ligament.u]
from = { body = "bone", point = [0, -10, 2] }
to = { body = "ground", point = [3, -25, -15] }
law = "spring"
stiffness = 20
reference_force = 12
[load.push]
body = "bone"
force = [10, 5, -20]
point = [0, 0, 10]
frame = "body"
[[step]]
prescribe = { "j.c" = [0, 20] }
load = { push = [0, 1] }
increments = 8
)";
  expect_quadratic("ellipsoid in a bowl", scene_of(text), 6);
}

TEST(QuadraticConvergence, MeasuredKnee) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto scene = read_scene(folder.write("scene.toml", test::lenhart_scene("", 0, 90, 45)), out);
  ASSERT_TRUE(scene.has_value()) << test::messages(out);
  expect_quadratic("measured knee, meshes", *scene, 20);
}

}  // namespace
}  // namespace genu
