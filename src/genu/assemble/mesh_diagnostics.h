// What a stage that does not know the scene says of a mesh file, said of the key that named the file.
#pragma once

#include <string>

#include "genu/core/diagnostics.h"
#include "genu/scene/scene.h"

namespace genu {

/// Adds all of `found` to `out`, at the place and key of the scene where the file stands that it is about.
void add_at_key(const SceneTables& scene, const std::string& key, const PieceFiles& files, const Diagnostics& found,
                Diagnostics& out);

}  // namespace genu
