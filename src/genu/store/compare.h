// Results side by side: the report.html of several runs as one.
#pragma once

#include <string>
#include <vector>

#include "genu/core/diagnostics.h"

namespace genu {

/// `results`: folders that `genu run` wrote, or report.html themselves; at least two. Writes the page that compares the
/// first with the others into `file`. Returns the exit code; what is no result is refused in `out`, all of it at once.
[[nodiscard]] int compare_results(const std::vector<std::string>& results, const std::string& file, Diagnostics& out);

}  // namespace genu
