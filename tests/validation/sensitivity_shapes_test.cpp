// Derivatives to the numbers of every shape, law and joint, against the scene edited and solved again.
#include <string>

#include <gtest/gtest.h>

#include "support/scene_model.h"
#include "validation/sensitivity_case.h"

namespace genu::test {
namespace {

const std::string kDown = R"(
[load.weight]
body = "bone"
force = [1, 2, -40]
point = [1, -2, 0]
)";

/// Stays of every law and every way to say where they are slack, taut at the start.
std::string stays() {
  return ligament("spring_l", "[30, 5, 10]", "[60, 10, -20]", "law = \"spring\"\nstiffness = 3\nslack_length = 30") +
         ligament("spring_f", "[-30, 5, 10]", "[-60, 8, -20]",
                  "law = \"spring\"\nstiffness = 2\nreference_force = 12") +
         ligament("quadratic_f", "[5, 30, 10]", "[8, 50, -25]",
                  "law = \"quadratic\"\nstiffness = 20000\nreference_force = 20") +
         ligament("linear_e", "[5, -30, 10]", "[3, -55, -20]",
                  "law = \"linear\"\nstiffness = 900\nreference_strain = 0.03") +
         ligament("toe_f", "[20, 20, 10]", "[35, 40, -25]",
                  "law = \"blankevoort\"\nstiffness = 2000\ntransition_strain = 0.06\nreference_force = 15") +
         ligament("line_f", "[-20, 20, 10]", "[-35, 38, -25]",
                  "law = \"blankevoort\"\nstiffness = 1500\ntransition_strain = 0.03\nreference_force = 60") +
         ligament("line_l", "[-20, -20, 10]", "[-35, -40, -22]",
                  "law = \"blankevoort\"\nstiffness = 1200\ntransition_strain = 0.03\nslack_length = 38") +
         ligament("hefzy_toe", "[20, -20, 10]", "[32, -42, -25]",
                  "law = \"abdel-rahman\"\nstiffness = 30\ntoe_stiffness = 6\ntransition_strain = 0.2\n"
                  "reference_force = 14") +
         ligament("hefzy_line", "[0, -25, 15]", "[2, -45, -25]",
                  "law = \"abdel-rahman\"\nstiffness = 20\ntoe_stiffness = 8\ntransition_strain = 0.02\n"
                  "reference_strain = 0.05") +
         ligament("table_f", "[25, 0, 15]", "[50, 2, -25]",
                  "law = \"table\"\npoints = [[0, 0], [0.05, 10], [0.1, 40], [0.2, 150]]\nreference_force = 15") +
         ligament("table_e", "[-25, 0, 15]", "[-50, -2, -25]",
                  "law = \"table\"\npoints = [[0, 0], [0.05, 10], [0.1, 40], [0.2, 150]]\nreference_strain = 0.06") +
         ligament("wrapped", "[10, 25, 12]", "[15, 60, -25]",
                  "via = [{ body = \"bone\", point = [12, 30, 8] }, { body = \"ground\", point = [14, 45, -8] }]\n"
                  "law = \"quadratic\"\nstiffness = 9000\nreference_force = 9") +
         ligament("slack", "[0, 25, 15]", "[0, 45, -25]", "law = \"quadratic\"\nstiffness = 5000\nslack_length = 90");
}

const std::string kTurned = step("prescribe = { \"j.a\" = [0, 0.2] }\nincrements = 4");

TEST(SensitivityOfShapes, Polynomials) {
  compare(
      "polynomials, all laws",
      bone_on_ground("{ z = 20, x = 1, b = 0.02 }") +
          surface("condyle", "bone", "polynomial",
                  "chart = \"cylindrical\"\nx_axis = [0, 0.1, -1]\nz_axis = [1, 0, 0]\n"
                  "terms = [[0, 0, 20], [1, 0, 0.4], [2, 0, -0.5], [0, 2, -0.00005], [1, 1, 0.001], [0, 1, 0.005]]") +
          surface("plateau", "ground", "polynomial",
                  "origin = [0.5, -0.3, 0.2]\nterms = [[1, 0, 0.02], [0, 1, -0.03], [2, 0, -0.002], [1, 1, 0.001], "
                  "[0, 2, -0.003], [3, 0, 0.000001], [0, 0, 0.1]]") +
          contact("foot", "condyle", "plateau") + stays() + kDown + kTurned,
      {0, 4}, {{"all"}, {"all"}}, 0.003);
}

TEST(SensitivityOfShapes, SocketAndCylinder) {
  compare("ellipsoid in a socket, cylinder on a sphere",
          bone_on_ground("{ z = 20 }") +
              surface("head", "bone", "ellipsoid", "radii = [12, 10, 14]\norigin = [-20, 0, 0]") +
              surface("socket", "ground", "sphere", "radius = 25\norigin = [-20, 0, 31]\ninside = true") +
              surface("rod", "bone", "cylinder",
                      "radius = 8\norigin = [25, 0, 0]\nz_axis = [0.2, 1, 0]\nx_axis = [1, -0.2, 0]") +
              surface("knob", "ground", "sphere", "radius = 12\norigin = [25, 1, 0]") +
              contact("hip", "head", "socket") + contact("rest", "knob", "rod") + stays() + kDown + kTurned,
          {0, 4});
}

TEST(SensitivityOfShapes, AContactThatHasOpened) {
  // The regions and the totals of a pair with one open contact, and its gap.
  compare("open contact",
          bone_on_ground("{ z = 20 }") + surface("ball", "bone", "ellipsoid", "radii = [15, 18, 20]") +
              surface("floor", "ground", "polynomial", "terms = [[2, 0, -0.004], [0, 2, -0.006], [1, 0, 0.01]]") +
              contact("foot", "ball", "floor") + stays() + load("lift", "force = [0, 0, 1]\npoint = [1, 2, 3]") +
              step("prescribe = { \"j.a\" = [0, 0.1] }\nload = { lift = [-50, 600] }\nincrements = 3"),
          {0, 3}, {{"all"}, {"all"}}, 0.001);
}

TEST(SensitivityOfShapes, APairThatNeverTouched) {
  compare("never closed",
          bone_on_ground("{ z = 20 }") + surface("ball", "bone", "ellipsoid", "radii = [15, 18, 20]") +
              surface("floor", "ground", "sphere", "radius = 60\norigin = [0, 0, -60]") +
              surface("stop", "ground", "sphere", "radius = 20\norigin = [4, 60, 22]") +
              contact("foot", "ball", "floor") + contact("guard", "ball", "stop") + stays() +
              load("lift", "force = [0, 0, 1]\npoint = [1, 2, 3]") +
              step("prescribe = { \"j.a\" = [0, 0.1] }\nload = { lift = [-50, -20] }\nincrements = 3"),
          {3}, {{"guard.gap", "foot.force"}, {"stop.*", "ball.radii.*", "spring_l.stiffness"}}, 0.001);
}

TEST(SensitivityOfShapes, HingesWeightsAndCombinations) {
  compare("joints", R"(format = 1
units = { length = "mm", angle = "deg" }
gravity = [0.5, 0.2, -9.81]
[body.ground]
fixed = true
[body.thigh]
mass = 8
centre_of_mass = [10, 5, -170]
[body.shank]
mass = 4
centre_of_mass = [5, 0, -180]
[body.foot]
mass = 1
centre_of_mass = [60, 0, -30]
[joint.hip]
type = "revolute"
parent = "ground"
child = "thigh"
axis = [0.1, 1, 0]
stiffness = 0.5
[joint.knee]
type = "revolute"
parent = "thigh"
child = "shank"
origin = [0, 0, -400]
axis = [0, 1, 0.2]
stiffness = 0.3
[joint.ankle]
type = "fixed"
parent = "shank"
child = "foot"
origin = [0, 0, -380]
[combination.both]
terms = { "hip.angle" = 1, "knee.angle" = -0.5 }
[ligament.strap]
from = { body = "thigh", point = [40, 0, -350] }
to = { body = "shank", point = [50, 10, -60] }
law = "linear"
stiffness = 500
reference_strain = 0.02
[load.toe]
body = "foot"
force = [-5, 2, 8]
point = [120, 0, -60]
frame = "body"
[load.bend]
on = "knee.angle"
value = 2
[[step]]
prescribe = { "both" = [0, 20] }
increments = 3
[[step]]
increments = 2
)",
          {0, 3, 5});
}

}  // namespace
}  // namespace genu::test
