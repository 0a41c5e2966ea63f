// Puts the shards of a sweep together.
#pragma once

#include <string>

#include "genu/core/diagnostics.h"

namespace genu {

/// Writes samples.csv, samples.npz, statistics.csv, events.csv, ranks.csv, indices.csv (with Saltelli's scheme),
/// convergence.csv, summary.json and report.html into the folder: the same bytes however it was divided. `text` gets a
/// summary for a terminal. Returns the exit code; what is missing, cut short or of another study is named in `out`.
[[nodiscard]] int merge_sweep(const std::string& folder, Diagnostics& out, std::string& text);

}  // namespace genu
