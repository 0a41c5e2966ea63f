// A small knee with the ligaments that `genu new` writes: two wheels of the femur roll on the flat tibia. x is
// anterior, z proximal, y medial.
#pragma once

#include <string>

#include <fmt/format.h>

namespace genu::test {

inline std::string bundled_knee() {
  std::string out = R"(format = 1
title = "two wheels on a plate"
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
grood_suntay = { side = "right", femur = { body = "femur", proximal = "z", anterior = "x" }, tibia = { body = "tibia", proximal = "z", anterior = "x" } }
[surface.plate]
body = "tibia"
shape = "plane"
)";
  for (const auto& [name, y] : {std::pair("medial", 20), std::pair("lateral", -20)})
    out += fmt::format(
        "[surface.{0}_wheel]\nbody = \"femur\"\nshape = \"torus\"\nmajor_radius = 12\nminor_radius = 8\n"
        "origin = [0, {1}, 0]\nz_axis = [0, 1, 0]\nx_axis = [1, 0, 0]\n"
        "[contact.{0}]\nsurfaces = [\"{0}_wheel\", \"plate\"]\nmodel = \"rigid\"\n",
        name, y);
  struct Fibre {
    const char *name, *from, *to;
    double stiffness, slack;  ///< N, mm
  };
  constexpr Fibre kFibres[] = {{"ACLam1", "[-10, 4, 2]", "[12, 0, 0]", 20000, 30.2},
                               {"PCLal1", "[10, -4, 2]", "[-12, 0, 0]", 20000, 30.4},
                               {"MCLs1", "[0, 25, 0]", "[5, 26, -20]", 20000, 39.5},
                               {"MCLp1", "[-3, 22, 0]", "[-14, 24, -5]", 9000, 27},
                               {"LCL1", "[0, -25, 0]", "[-6, -24, -20]", 16000, 39.6},
                               {"pCAP1", "[0, 15, 0]", "[-3, 16, -15]", 9000, 35},
                               {"pCAP2", "[0, -15, 0]", "[-3, -16, -15]", 9000, 35},
                               {"meniscus_1", "[0, 20, 0]", "[80, 40, 20]", 2000, 80.5},
                               {"meniscus_2", "[0, -20, 0]", "[80, -40, 20]", 2000, 80.5},
                               {"meniscus_3", "[0, 20, 0]", "[-80, 40, 20]", 2000, 80.5},
                               {"meniscus_4", "[0, -20, 0]", "[-80, -40, 20]", 2000, 80.5}};
  for (const Fibre& f : kFibres)
    out += fmt::format(
        "[ligament.{}]\nfrom = {{ body = \"femur\", point = {} }}\nto = {{ body = \"tibia\", point = {} }}\n"
        "law = \"quadratic\"\nstiffness = {}\nslack_length = {}\n",
        f.name, f.from, f.to, f.stiffness, f.slack);
  return out + "[[step]]\nprescribe = { \"knee.flexion\" = [0, 90] }\nincrements = 30\n";
}

}  // namespace genu::test
