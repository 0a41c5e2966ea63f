// The joint that tables of poses are read for: a knee and a hinge, a load in time and one that is not.
#pragma once

#include "fuzz/fuzz_checks.h"
#include "genu/scene/reader.h"

namespace genu::fuzz {

inline const Scene& table_scene() {
  static const Scene scene = [] {
    Diagnostics out;
    auto read = parse_scene(R"(format = 1
units = { length = "mm", angle = "deg" }
[body.femur]
fixed = true
[body.tibia]
[body.patella]
[joint.knee]
type = "free"
parent = "femur"
child = "tibia"
rotations = ["flexion -z", "adduction x", "rotation y"]
translations = ["tx", "ty", "tz"]
[joint.hinge]
type = "revolute"
parent = "femur"
child = "patella"
axis = [0, 0, 1]
[load.push]
body = "tibia"
force = [0, 1, 0]
[load.swing]
body = "tibia"
force = [0, 1, 0]
scale = { over = "time", table = [[0, 0], [1, 1]] }
[[step]]
)",
                            "scene.toml", out);
    for (const Diagnostic& d : out.items()) std::fprintf(stderr, "%s\n", to_string(d).c_str());
    require(read.has_value(), "the scene of the tables is a good one");
    return *read;
  }();
  return scene;
}

}  // namespace genu::fuzz
