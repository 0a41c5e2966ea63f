// report.html of a sweep: counts, charts, and the samples that jumped or failed. One file, without a network.
#pragma once

#include <string>

#include "genu/sweep/summary_tables.h"

namespace genu {

std::string sweep_page(const SweepTable& sweep, const SweepTables& tables);

}  // namespace genu
