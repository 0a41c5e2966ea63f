// A scene file with a setting written into it, and the meshes that it needs beside it.
#pragma once

#include <string>

#include "genu/run/accuracy_settings.h"

namespace genu {

/// Writes `folder`/scene.toml, a copy of the file that `prepared` was read from with the setting in it, and the meshes
/// that are coarser than the scene's own. What the solver's tolerance was stays with the program. Returns what went
/// wrong, else an empty text.
std::string write_chosen_scene(const std::string& file, const Prepared& prepared, const AccuracySetting& setting,
                               const std::string& folder);

}  // namespace genu
