// Starts of a fit from which it can see all unknowns: rows that can be solved, ligaments that are taut somewhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/calibrate/calibration_problem.h"

namespace genu {

/// A start with residuals, with derivatives: u itself, or with slack lengths shorter by the least of kShorterLengths
/// with which all rows are solved. A knee whose ligaments are too long has no pose under some of the loads.
struct SolvableStart {
  CalibrationProblem::At at;  ///< of u, where there is none
  std::string how;            ///< "lengths 2 % shorter"; empty: u itself
};
SolvableStart solvable_start(const CalibrationProblem& problem, const VecX& u);

/// u at which the member of an unknown that is nearest to taut has this strain where it is longest.
/// Empty where that needs another law, or goes beyond the unknown's bounds.
std::optional<double> taut_start(const CalibrationUnknown& unknown, double u,
                                 const std::vector<CalibrationPrediction::Stretch>& stretch, double strain);

}  // namespace genu
