// One sample as a scene that any command takes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "genu/sweep/sweep.h"

namespace genu {

/// The scene of a sample, whose results go to `folder`. A sample with meshes of its own gets them and a scene file in
/// FOLDER.scene, beside. Empty, with errors in `out`, where that cannot be written.
[[nodiscard]] std::optional<SceneSource> write_sample(const Sweep& sweep, const SweepCase& in, std::uint64_t sample,
                                                      const std::string& folder, Diagnostics& out);

}  // namespace genu
