// All rows of a sweep, put together from its shards.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/sweep/shard_file.h"
#include "genu/sweep/sweep_record.h"

namespace genu {

struct SweepTable {
  SweepRecord record;
  std::vector<std::vector<double>> draws;  ///< [factor][sample]
  struct Case {
    std::vector<std::string> classes, reasons;  ///< [sample]
    std::vector<double> jumps, jump_at;         ///< [sample]
    std::vector<std::vector<double>> kept;      ///< [kept number][sample]
    std::size_t reference = 0;                  ///< the case of the same scene as it is; itself where there is none
    std::string study{};                        ///< file of the study
    std::string name{};                         ///< of the case for --case; empty where the study has one
  };
  std::vector<Case> cases;

  /// "mean" or, of several cases, "mean, acl_cut"; of several scenes with the scene in front.
  std::string case_name(std::size_t c) const;
  /// Whether a sample repeats draws of others: the rows of Saltelli's blocks behind A and B.
  bool repeats_draws(std::size_t sample) const { return record.block > 1 && sample % record.block >= 2; }
  /// The values of samples that are independent: all that repeat no draws.
  std::vector<double> independent(const std::vector<double>& values) const;
};

/// Reads the shards of a folder, one after another. `row` gets the lines of samples.csv: the column names, then the
/// rows in order. Empty, with the reasons in `out`, where shards are missing, cut short, or of another study. A warning
/// where different programs computed them.
[[nodiscard]] std::optional<SweepTable> read_sweep_table(const std::string& folder, const EachRow& row,
                                                         Diagnostics& out);

}  // namespace genu
