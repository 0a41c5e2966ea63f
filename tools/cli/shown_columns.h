// Which columns of results.csv a terminal shows.
#pragma once

#include <string>
#include <vector>

#include "genu/results/result_table.h"

namespace genu::cli {

/// What a reader looks at first, in the table's order: coordinates of joints and the force of every pair and region,
/// then as many reactions as there is room for, without those that are zero in all rows; energy, stability and status.
std::vector<std::string> columns_of_run(const ResultTable& table);

}  // namespace genu::cli
