// Distributions of one number, by their quantiles: one uniform number gives one draw.
#pragma once

#include <limits>
#include <vector>

namespace genu {

struct Distribution {
  enum class Kind {
    given,      ///< no distribution: the numbers come from a file
    normal,     ///< truncated to [low, high]
    lognormal,  ///< the same, of the logarithm
    uniform,    ///< from low to high
    values      ///< one of `values`
  };
  Kind kind = Kind::given;
  double mean = 0, sd = 1;  ///< of the number, or of its logarithm
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  std::vector<double> values, weights;  ///< weights: > 0, one for each value

  /// The number below which a share u of all draws lies, 0 < u < 1.
  double quantile(double u) const;
  /// No draw is below: quantile() at the smallest number that a design can give.
  double smallest() const;
};

/// Of a lognormal number with this mean and standard deviation, both > 0.
Distribution lognormal(double mean, double sd);

}  // namespace genu
