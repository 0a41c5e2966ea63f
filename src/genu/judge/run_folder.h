// The folder that a run wrote: its table, and which scene it is of.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"

namespace genu::judge {

struct RunFolder {
  std::string scene;                     ///< path of the scene file
  std::string results;                   ///< text of results.csv
  std::optional<std::size_t> ok_rows{};  ///< of which so many are called ok, as summary.json says
};

/// Reads results.csv and summary.json of `folder`. `scene`: of the caller's choice where it is not empty. A warning for
/// each file that has other bytes than the run read, as the summary tells, for a table with other bytes than it
/// wrote, and where it was stopped; an error where the summary is none, a file is missing, the table has more or fewer
/// rows, or, but with `given_too`, the results are of poses that were given and
/// not solved.
std::optional<RunFolder> read_run_folder(const std::string& folder, const std::string& scene, Diagnostics& out,
                                         bool given_too = false);

}  // namespace genu::judge
