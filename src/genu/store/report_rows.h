// Which rows of a long result are shown in report.html.
#pragma once

#include "genu/results/report_run.h"

namespace genu {

/// Where the rows of a run have more than `most` numbers, every n-th row of a run alone: its table, curves, poses,
/// contacts and courses. The last row stays, and `ReportRun::every` is n. The rows that stay; empty where all do.
std::vector<std::size_t> thin_rows(ReportRun& run, std::size_t most);

}  // namespace genu
