// What a solved scene hands to report.html.
#pragma once

#include "genu/assemble/prepare.h"
#include "genu/assemble/solution.h"
#include "genu/results/report.h"
#include "genu/store/report_limits.h"

namespace genu {

/// Everything the page shows of a solution, equilibria or motion, and what was measured `beside` it, within `limits`.
/// `prepared` and `solution` must outlive it.
ReportRun report_run(const Prepared& prepared, const Solution& solution, std::vector<ReportBeside> beside = {},
                     const ReportLimits& limits = {});

/// Adds report.html to the files of a result, and the time it takes to the summary.
void add_report(const Prepared& prepared, Solution& solution, std::vector<std::pair<std::string, std::string>>& files,
                const std::vector<ReportPicture>& pictures = {}, std::vector<ReportBeside> beside = {});

}  // namespace genu
