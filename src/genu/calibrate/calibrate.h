// Numbers of a scene fitted so that its results follow what was measured: least squares over motions, paths of
// equilibria and laxity tables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/calibrate/calibration_unknowns.h"
#include "genu/calibrate/zero_load.h"
#include "genu/results/calibration_table.h"
#include "genu/study/run_scene.h"

namespace genu {

struct CalibrationChoice {
  /// CSV files (calibration_target.h, laxity_target.h), or "SCENE=FILE" for what another scene with some of the same
  /// parameters is to follow.
  std::vector<std::string> targets;
  std::vector<std::string> vary;  ///< calibration_unknowns.h, as bounds and priors
  std::vector<std::string>
      columns;  ///< of the targets; of a run all, of a laxity table displacements where none is named
  int most_iterations = 50;
  std::vector<std::string> bounds = {}, priors = {};
  std::vector<std::string> errors = {};    ///< "COLUMN=SIGMA": stated errors of measurement, in the column's unit
  std::vector<std::string> held_out = {};  ///< targets that are not fitted but predicted
  int starts = 1;
  double spread = 3;                              ///< of the starts, in standard changes
  double compression = 0;                         ///< N, of laxity tests
  ZeroLoadChoice zero_load = {};                  ///< where the lengths start; without targets: where they end
  std::vector<std::string> candidates = {};       ///< laxity tables, each curve of which could be measured
  std::vector<std::string> narrow = {};           ///< unknowns that these are to narrow; none: all
  std::vector<std::string> predict_columns = {};  ///< of targets held out, in the place of `columns`
};

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
