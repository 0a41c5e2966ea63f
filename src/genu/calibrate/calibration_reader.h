// What the files of a calibration are: measurements to follow, to predict, and those that could be made.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "genu/assemble/solution.h"
#include "genu/calibrate/calibration_choice.h"
#include "genu/calibrate/calibration_design.h"

namespace genu {

struct CalibrationExperiments {
  std::vector<std::unique_ptr<CalibrationExperiment>> followed;  ///< with those held out
  std::vector<DesignCandidate> candidates;
};

/// `unknowns` must outlive the experiments. What cannot be followed, and errors that are missing, are refused in `out`.
CalibrationExperiments read_experiments(const Prepared& prepared, const std::vector<CalibrationUnknown>& unknowns,
                                        const CalibrationChoice& choice, const RunOptions& options, Diagnostics& out);

/// "SCENE" and "FILE" of "SCENE=FILE"; the scene is empty where there is none.
std::pair<std::string, std::string> parts_of_target(const std::string& target);

}  // namespace genu
