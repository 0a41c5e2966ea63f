// A crank that turns about z on a frame, for cords and cables between the two.
#pragma once

#include <string>

namespace genu::test {

/// A scene of the crank and `rest`. (The flap is there because something has to be free.)
inline std::string crank_scene(const std::string& rest) {
  return R"(format = 1
units = { length = "mm", angle = "deg" }
[body.frame]
fixed = true
[body.crank]
[joint.hinge]
type = "revolute"
parent = "frame"
child = "crank"
axis = [0, 0, 1]
[body.flap]
[joint.flap]
type = "revolute"
parent = "frame"
child = "flap"
axis = [0, 0, 1]
stiffness = 1
)" + rest;
}

}  // namespace genu::test
