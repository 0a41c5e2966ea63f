// Numbers of a scene fitted so that its results follow a target: least squares, over motions and paths alike.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/results/calibration_table.h"
#include "genu/study/run_scene.h"

namespace genu {

struct CalibrationChoice {
  std::string target;                ///< CSV file, calibration_target.h
  std::vector<std::string> vary;     ///< names of parameters (model/parameters.h), * and ? stand for letters
  std::vector<std::string> columns;  ///< of the target; all where none is named
  int most_iterations = 50;
};

struct CalibrationResult {
  Solution solution;  ///< of the scene with the fitted values
  CalibrationReport report;
};

/// Fits, and writes the fitted scene's results with calibration.csv, comparison.csv and scene.toml into `folder` where
/// there is one. Stiffnesses, dampings, masses and slack lengths are fitted by their logarithms and so stay positive;
/// derivatives are central differences. Returns the exit code: incomplete where the fit has not converged or the target
/// leaves a parameter undetermined. Names that are none and a target that cannot be followed are refused in `out`.
[[nodiscard]] int run_calibration(const SceneSource& source, const std::optional<std::string>& folder,
                                  const CalibrationChoice& choice, const RunOptions& options, Diagnostics& out,
                                  CalibrationResult& result);

}  // namespace genu
