// What the uncertainty of fitted numbers means for results: standard errors of every result, linear, and a study for
// `genu sweep` that draws the numbers with their correlations.
#pragma once

#include <string>
#include <vector>

#include "genu/calibrate/calibration_experiment.h"
#include "genu/results/result_table.h"

namespace genu {

/// One row a pose, one column for each column of results.csv that has an exact derivative: its standard error, in its
/// unit. Empty cells: the pose has no derivative. Numbers that the target does not determine do not count.
///
///   s^2 = g^T C g,   g = dy/du
///
/// `unknowns`: those of the fit, whose scene `fitted` is at u.
ResultTable result_errors(const ScenesUnknowns& unknowns, const Prepared& fitted, const VecX& u,
                          const std::vector<PoseRecord>& records, const MatX& covariance);

/// The text of a study of `scene_file`, whose text is `scene_text`: shares are lognormal, offsets normal, with the
/// correlations of the fit. Keeps coordinates and forces of contacts at all rows. `deviations` of u: infinite ones are
/// left out. Empty where nothing is left, or the scene has motion.
std::string sweep_study(const Prepared& fitted, const std::string& scene_file, const std::string& scene_text,
                        const std::vector<CalibrationUnknown>& unknowns, const VecX& deviations,
                        const MatX& correlation);

}  // namespace genu
