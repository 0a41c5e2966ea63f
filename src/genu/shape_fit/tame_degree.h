// Whether a fitted polynomial may be written down over all of a patch, also where no sample held it.
#pragma once

#include <vector>

#include "genu/shape_fit/polynomial_fit.h"

namespace genu {

/// The highest degree from `degree` down (at least kLowestFitDegree, which passes unseen) whose polynomial neither
/// folds over the patch (72 deg steep against the chart, or a radius below a fifth of the middle one) nor leaves the
/// paraboloid that fits best by more than twice as much as it does on the samples.
int highest_tame_degree(const PolynomialFit& fit, const std::vector<HeightSample>& samples, const ChartBox& patch,
                        bool cylindrical, int degree);

}  // namespace genu
