// What a stage that does not know the scene says of a mesh file, said of the key that named the file.
#pragma once

#include <string>

#include "genu/core/diagnostics.h"
#include "genu/scene/scene.h"

namespace genu {

/// Adds all of `found` to `out`, at the place and key of the scene where `mesh_file` stands.
void add_at_key(const SceneTables& scene, const SourceLocation& where, const std::string& key,
                const std::string& mesh_file, const Diagnostics& found, Diagnostics& out);

}  // namespace genu
