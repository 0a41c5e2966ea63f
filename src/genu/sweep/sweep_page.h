// report.html of a sweep: counts, charts, and the samples that jumped or failed. One file, without a network.
#pragma once

#include <string>

#include "genu/sweep/summary_tables.h"

namespace genu {

std::string sweep_page(const SweepTable& sweep, const SweepTables& tables);

/// The page of several studies, as join_sweeps() puts them together. `about`: a line below the title.
std::string compared_page(const SweepTable& all, const SweepTables& tables, const std::string& title,
                          const std::string& about);

}  // namespace genu
