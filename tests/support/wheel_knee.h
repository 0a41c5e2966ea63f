// A small closed knee for laxity tests: a wheel (a torus) of the femur rolls on the flat tibia, held by springs. x is
// anterior, z proximal, y to the left.
#pragma once

#include <array>
#include <string>

#include <fmt/format.h>

namespace genu::test {

/// The wheel on its plate without springs; side: "right" or "left".
inline std::string wheel_on_plate(const std::string& side) {
  return R"(format = 1
title = "wheel on a plate"
units = { length = "mm", angle = "deg" }
[body.femur]
fixed = true
[body.tibia]
[joint.knee]
type = "free"
parent = "femur"
child = "tibia"
rotations = ["flexion y", "adduction x", "rotation -z"]
translations = ["x", "y", "z"]
reference = { z = -20 }
grood_suntay = { side = ")" +
         side +
         R"(", femur = { body = "femur", proximal = "z", anterior = "x" }, tibia = { body = "tibia", proximal = "z", anterior = "x" } }
[surface.wheel]
body = "femur"
shape = "torus"
major_radius = 12
minor_radius = 8
z_axis = [0, 1, 0]
x_axis = [1, 0, 0]
[surface.plate]
body = "tibia"
shape = "plane"
[contact.medial]
surfaces = ["wheel", "plate"]
model = "rigid"
)";
}

/// Ligaments without symmetry, with these slack lengths in mm; all are taut without load.
inline std::string wheel_knee(const std::array<double, 5>& slack = {25, 20, 19.2, 24, 24}) {
  std::string out = wheel_on_plate("right");
  struct Spring {
    const char *name, *from, *to;
    double stiffness;  ///< N
  };
  constexpr Spring kSprings[] = {{"ahead", "[-25, 3, -19]", "[1, 0, 0]", 20000},
                                 {"left", "[2, 25, 0]", "[0, 26, -1]", 40000},
                                 {"right", "[-3, -25, 0]", "[0, -24, 0]", 36000},
                                 {"across", "[1, 25, -18]", "[0, 0, 0]", 18000},
                                 {"behind", "[25, -2, -19]", "[0, 1, 0]", 22000}};
  for (std::size_t k = 0; k < slack.size(); ++k)
    out += fmt::format(
        "[ligament.{}]\nfrom = {{ body = \"femur\", point = {} }}\nto = {{ body = \"tibia\", point = {} }}\nlaw = "
        "\"quadratic\"\nstiffness = {}\nslack_length = {:.17g}\n",
        kSprings[k].name, kSprings[k].from, kSprings[k].to, kSprings[k].stiffness, slack[k]);
  return out + "[bundle.sides]\nfibres = [\"left\", \"right\"]\n" +
         "[[step]]\nprescribe = { \"knee.flexion\" = [0, 20] }\nincrements = 10\n";
}

}  // namespace genu::test
