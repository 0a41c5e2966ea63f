// A scene file with a setting of its meshes and its solver written into it, and the meshes that it needs beside it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/study/accuracy_settings.h"

namespace genu {

/// Names and contents of the files: scene.toml, a copy of the file that `prepared` was read from with another degree,
/// fit radius or mesh in the tables of its surfaces and another tolerance of its solver, paths leading from `folder`,
/// and those meshes. A table that is not written with a header of its own is an error in `out`, at its place.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> chosen_scene(const std::string& file,
                                                                            const Prepared& prepared,
                                                                            const AccuracySetting& setting,
                                                                            const std::string& folder,
                                                                            Diagnostics& out);

}  // namespace genu
