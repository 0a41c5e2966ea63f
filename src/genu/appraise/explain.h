// What a scene asks for, in words and counts, before anything is solved: bodies, coordinates, effects, and the system
// of every step, unknowns beside equations, block by block.
#pragma once

#include <string>

#include "genu/scene/scene.h"

namespace genu {

/// Some tens of lines for the terminal. Opens no mesh.
std::string explain(const SceneTables& scene);

}  // namespace genu
