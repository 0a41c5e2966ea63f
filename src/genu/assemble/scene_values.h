// A scene's text with other numbers, and with its meshes' names as they are seen from another folder; everything else
// as its author wrote it.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/model/parameters.h"

namespace genu {

/// The text of `scene`, read from `file`, with the numbers (SI) of some parameters in their places, with as many digits
/// as bring back the same double, and relative paths of meshes leading from `folder`. A parameter that the file does
/// not say as a number of its own (left out, so that a default holds), or a name of a mesh that cannot be replaced, is
/// an error in `out`.
[[nodiscard]] std::string with_values(const std::string& file, const SceneTables& scene,
                                      const std::vector<std::pair<Parameter, double>>& values,
                                      const std::string& folder, Diagnostics& out);

/// The `text` of a scene with other names of its mesh files: `rename` gives them, and is called for each once. As it is
/// where it is no TOML.
std::string with_mesh_names(const std::string& text, const std::function<std::string(const std::string&)>& rename);

}  // namespace genu
