// What a sweep says: tables of statistics, summary.json, and a text for a terminal. Of Saltelli's scheme the Sobol
// indices use all rows, every other table the independent ones alone (SweepTable::independent()).
#pragma once

#include <string>

#include "genu/results/result_table.h"
#include "genu/sweep/sweep_table.h"

namespace genu {

/// A row for each kept number of each case, and of the difference between each what-if and the scene as it is, sample
/// by sample: count, mean and SD, extremes, and percentiles. 95 % intervals here and below are those of random designs.
ResultTable statistics_table(const SweepTable& sweep);
/// Probabilities of events: jumped, not solved, doubtful, refused.
ResultTable event_probabilities(const SweepTable& sweep);
/// Spearman's rank correlation of each factor and each kept number.
ResultTable rank_table(const SweepTable& sweep);
/// Sobol indices of each factor and kept number; no rows without Saltelli's scheme.
ResultTable index_table(const SweepTable& sweep);
/// Mean, SD and percentiles of the first 16, 32, 64, ... samples.
ResultTable convergence_table(const SweepTable& sweep);

/// summary.json: what the sweep is, and the tables above in short.
std::string summary_json(const SweepTable& sweep);
std::string summary_text(const SweepTable& sweep);

/// Kept number k of the what-if of case c minus that of the scene as it is.
std::vector<double> difference(const SweepTable& sweep, std::size_t c, std::size_t k);

}  // namespace genu
