// What a calibration is asked for.
#pragma once

#include <string>
#include <vector>

#include "genu/calibrate/calibration_unknowns.h"
#include "genu/calibrate/zero_load.h"

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

}  // namespace genu
