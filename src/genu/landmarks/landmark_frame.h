// Frames of images, named by the directions of their axes: "LPS" is left, posterior, superior.
#pragma once

#include <string>

#include "genu/core/types.h"

namespace genu {

/// What takes a point's numbers from one frame to another. Each name has one letter of each of RL, AP and SI.
Mat3 turn_between(const std::string& from, const std::string& to);

}  // namespace genu
