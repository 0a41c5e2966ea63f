// What report.html shows, as JSON for the page's program (src/report_page/data.js reads it).
#pragma once

#include <string>
#include <vector>

#include "genu/results/report_run.h"

namespace genu {

/// Lengths in mm, angles in deg, arrays of numbers as packed_numbers.h has them. One line, with every <, > and & of a
/// text escaped, so that it can stand inside an HTML element.
std::string report_data(const std::vector<ReportRun>& runs);

/// What a run took, and how often each effect was evaluated: the only part that differs from time to time.
std::string report_times(const std::vector<ReportRun>& runs);

}  // namespace genu
