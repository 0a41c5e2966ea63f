// The standard normal distribution and its inverse: one uniform number becomes one normal number.
#pragma once

namespace genu {

/// Probability below z.
double normal_probability(double z);

/// The inverse of it, 0 < p < 1, within 1e-15 of its value or so: algorithm AS 241 (Wichura 1988), PPND16.
double normal_quantile(double p);

}  // namespace genu
