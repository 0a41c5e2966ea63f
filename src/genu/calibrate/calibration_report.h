// What a calibration's search has found, in numbers and words: values with errors, what is not determined, the fit.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/calibrate/calibration_search.h"
#include "genu/results/calibration_table.h"

namespace genu {

struct CalibrationFindings {
  CalibrationReport report;
  ResultTable comparison;  ///< one row a value of all targets: target, scene, difference, standard error of the scene
  std::vector<std::pair<std::string, std::string>> pictures;  ///< file's name, SVG
  MatX covariance;                                            ///< of u
};

/// `search.at_end` must have residuals. Predicts what is held out.
CalibrationFindings find_out(const CalibrationProblem& problem, const CalibrationSearch& search);

}  // namespace genu
