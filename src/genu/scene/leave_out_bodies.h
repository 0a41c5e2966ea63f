// Leaving out bodies with everything that is on them, as for a knee without its menisci.
#pragma once

#include <string>
#include <vector>

#include "genu/scene/scene.h"

namespace genu {

/// Why the bodies of these indices cannot be left out: one is fixed, or carries a body that stays. Empty if they can.
std::string cannot_leave_out(const SceneTables& scene, const std::vector<int>& bodies);

/// Takes bodies out of a checked scene, and what needs them: their joints (with combinations, prescribed values and
/// loads on these), surfaces, contacts, paths that end on them or wrap round them, bushings and loads.
void leave_out_bodies(SceneTables& scene, const std::vector<int>& bodies);

}  // namespace genu
