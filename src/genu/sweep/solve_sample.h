// One run of a sweep: one sample solved in one case.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/cancelled.h"
#include "genu/results/result_table.h"
#include "genu/sweep/sweep.h"

namespace genu {

struct SampleResult {
  std::vector<double> draws;  ///< of each factor
  std::string verdict;        ///< class: "solved", "doubtful", "not_solved"; "refused" where no scene has the numbers
  int jumps = 0;              ///< of the joint to another position
  double jump_at = 0;         ///< main coordinate of the first one; NaN: none
  std::vector<double> kept;   ///< of each kept number; NaN: not found
  std::string reason;         ///< of every class but solved
  std::optional<ResultTable> table{};  ///< results.csv, where the study keeps tables
};

/// Shares with other samples what their numbers do not change. Empty where it was called off. Depends on the study, the
/// case and the sample alone.
[[nodiscard]] std::optional<SampleResult> solve_sample(const Sweep& sweep, const SweepCase& in, std::uint64_t sample,
                                                       const Cancelled& cancelled);

}  // namespace genu
