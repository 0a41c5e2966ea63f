// What coordinates are called in files for OpenSim.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/results/opensim_tables.h"

namespace genu {

struct OpenSimNameOptions {
  std::string columns = {};  ///< "knee.flexion=knee_angle_r, ...": names of the user's own
  std::string side =
      {};  ///< "r" or "l": at the end of all other names; empty: as the scene's grood_suntay says, or none
};

/// A name for each coordinate that no joint holds: as said, else in the way of the published OpenSim-JAM knees, which
/// `genu evaluate` understands: knee_flex_r, knee_add_r, knee_tx_r. Words and names that cannot be, and two alike, are
/// refused in `out`.
[[nodiscard]] std::optional<OpenSimNames> opensim_column_names(const SceneTables& scene,
                                                               const OpenSimNameOptions& options, Diagnostics& out);

}  // namespace genu
