// How far the columns of results.csv may be off because of the surfaces: the spread of the same scene solved on other
// surfaces that its meshes might as well have given.
//
//   fit    the largest distance from the results, of any variant
//   noise  twice the root mean square distance: about 95 % of what another measurement would give
//   mesh   what edges 1.5 times longer change, doubled: if errors grow with the edges (features met by fewer points;
//          smooth parts do better), the mesh itself is off by twice that
//
// The causes are independent: a bar is the root of the sum of their squares. Contacts pass a place of the path sooner
// or later from variant to variant, so a column may differ much in one row and not in the next; each share is the
// largest of its row and of those beside it. A variant that has no equilibrium any more, or no such contact, counts as
// far away as it last was.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "genu/results/result_table.h"

namespace genu {

enum class ErrorCause { fit, noise, mesh };
inline constexpr std::array kErrorCauses = {ErrorCause::fit, ErrorCause::noise, ErrorCause::mesh};
const char* to_string(ErrorCause cause);

/// The poses of one variant: a pose_table() of the same scene.
struct VariedPoses {
  ErrorCause cause = ErrorCause::fit;
  const ResultTable* poses = nullptr;
};

struct ErrorBars {
  /// The columns of `poses` that are measures (not the statuses, counts and residuals), same rows, bars in place of
  /// values; `variants` is the number of variants solved there. Empty where no variant has had the cell so far.
  ResultTable bars;
  /// step, increment, output, bar and the share of each cause, a row for each bar.
  ResultTable shares;
  /// For each column: the median and the largest bar, in which row that is, and the cause that is largest there.
  struct Largest {
    std::string column;
    double median = 0, largest = 0;
    std::size_t row = 0;
    ErrorCause cause = ErrorCause::fit;
  };
  std::vector<Largest> largest;
};

ErrorBars error_bars(const ResultTable& poses, const std::vector<VariedPoses>& variants);

}  // namespace genu
