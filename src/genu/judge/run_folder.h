// The output folder of a run: its table and its scene.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/scene/scene_changes.h"

namespace genu::judge {

struct RunFolder {
  SceneSource scene{""};                 ///< the scene file, and what the run changed in it
  std::string results;                   ///< text of results.csv
  std::optional<std::size_t> ok_rows{};  ///< number of rows called ok in summary.json
  std::string doubt{};                   ///< the first sentence of a verdict that has doubts, as summary.json has it
};

/// Reads results.csv and summary.json of `folder`. `scene`: replaces the recorded scene unless empty. Warns of each
/// file whose bytes differ from those that the run read or wrote, and of an interrupted run. Error where the summary is
/// invalid, a file is missing, the table has more or fewer rows, or (unless `given_too`) the results are of given poses
/// that were not solved.
[[nodiscard]] std::optional<RunFolder> read_run_folder(const std::string& folder, const std::string& scene,
                                                       Diagnostics& out, bool given_too = false);

}  // namespace genu::judge
