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
/// Probabilities of events: jumped, doubtful, not solved, refused, and those of the study's own.
ResultTable event_probabilities(const SweepTable& sweep);
/// Spearman's rank correlation of each factor and each kept number.
ResultTable rank_table(const SweepTable& sweep);
/// Sobol indices of each factor and kept number; no rows without Saltelli's scheme.
ResultTable index_table(const SweepTable& sweep);
/// Mean, SD and percentiles of the first 16, 32, 64, ... samples.
ResultTable convergence_table(const SweepTable& sweep);

/// All of them, computed once.
struct SweepTables {
  ResultTable statistics, events, ranks, indices, convergence;

  /// Row of `statistics` of kept number k in case c.
  static std::size_t statistics_row(const SweepTable& sweep, std::size_t c, std::size_t k);
  /// Row of `ranks` and of `indices` of factor f.
  static std::size_t factor_row(const SweepTable& sweep, std::size_t c, std::size_t k, std::size_t f);
};
SweepTables tables_of(const SweepTable& sweep);

/// summary.json: what the sweep is, and its tables in short.
std::string summary_json(const SweepTable& sweep, const SweepTables& tables);
std::string summary_text(const SweepTable& sweep, const SweepTables& tables);

/// Kept number k of the what-if of case c minus that of its reference, the scene as it is.
std::vector<double> difference(const SweepTable& sweep, std::size_t c, std::size_t k);

}  // namespace genu
