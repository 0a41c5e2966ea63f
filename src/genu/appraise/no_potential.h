// What gives a scene a stiffness that is not symmetric, which can drive an oscillation.
#pragma once

#include <string>
#include <vector>

#include "genu/scene/centre_bodies.h"

namespace genu {

/// By name, with the reason: "load push (it turns with tibia)", "the triangles of cartilage medial". Empty where all
/// has a potential.
std::vector<std::string> without_potential(const PlacedScene& scene);

}  // namespace genu
