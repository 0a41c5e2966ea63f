// Numbers of a scene fitted so that its results follow what was measured: least squares over motions, paths of
// equilibria and laxity tables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/calibrate/calibration_choice.h"
#include "genu/results/calibration_table.h"
#include "genu/study/run_scene.h"

namespace genu {

struct CalibrationResult {
  Solution solution;         ///< of the scene with the fitted values
  CalibrationReport report;  ///< without parameters where nothing was fitted
  std::string text;          ///< the rule's lengths and what could be measured, for a terminal
};

/// Fits, and writes the fitted scene's results with calibration.csv, comparison.csv, starts.csv, standard_errors.csv,
/// study.toml, pictures and scene.toml into `folder` where there is one; zero_load.csv, design.csv and design_order.csv
/// where they were asked for. Without targets nothing is fitted. Stiffnesses, dampings, masses and slack lengths are
/// fitted by their logarithms and so stay positive; derivatives are exact along a path of equilibria, and central
/// differences in motion. Returns the exit code: incomplete where the fit has not converged, a ligament is slack in
/// every pose, or the target leaves a parameter undetermined. Names that are none and a target that cannot be followed
/// are refused in `out`.
[[nodiscard]] int run_calibration(const SceneSource& source, const std::optional<std::string>& folder,
                                  const CalibrationChoice& choice, const RunOptions& options, Diagnostics& out,
                                  CalibrationResult& result);

}  // namespace genu
