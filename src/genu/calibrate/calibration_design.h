// Which measurement is worth making: how much each candidate would narrow the standard errors of unknowns, from the
// derivatives at the fitted values.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "genu/calibrate/calibration_experiment.h"
#include "genu/results/result_table.h"

namespace genu {

/// A measurement that could be made: its values have stated errors, and what was measured plays no part.
struct DesignCandidate {
  std::string name;  ///< "30 deg, drawer"
  std::unique_ptr<CalibrationExperiment> experiment;
};

struct CalibrationDesign {
  ResultTable ranked;  ///< one row a candidate, the best first: test, narrowing, standard errors with it
  ResultTable order;   ///< the best, then the best beside it, and so on: the same columns, cumulative
  std::string text;    ///< both, for a terminal
};

/// Ranks candidates by the geometric mean, over unknowns that match one of `named` (all without one), of the standard
/// error with the candidate over that without it.
///
///   C = (J^T J + W)^-1,   C_k = (J^T J + W + J_k^T J_k)^-1
///
/// `information`: J^T J of what is measured, and of priors, at u. W: an unknown without a prior counts as known within
/// kUnknownBefore standard changes, so that candidates can be compared before anything is measured.
CalibrationDesign rank_candidates(const std::vector<CalibrationUnknown>& unknowns, const VecX& u,
                                  const MatX& information, const std::vector<DesignCandidate>& candidates,
                                  const std::vector<std::string>& named);

}  // namespace genu
