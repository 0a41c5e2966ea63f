// Quantiles of differences, for comparisons with a twin.
#pragma once

#include <algorithm>
#include <vector>

namespace genu::test {

/// The value below which lies this share (0 to 1) of the values; 0.5: the median.
inline double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

}  // namespace genu::test
