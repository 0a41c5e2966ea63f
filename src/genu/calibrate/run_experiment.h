// Rows of a run as the target of a calibration (calibration_target.h): over time, or over a prescribed coordinate.
#pragma once

#include <memory>
#include <vector>

#include "genu/assemble/solution.h"
#include "genu/calibrate/calibration_experiment.h"
#include "genu/calibrate/calibration_target.h"

namespace genu {

/// Prescribed coordinates that only grow, or only fall, over the steps of a scene, with their ranges.
std::vector<TargetAxis> axes_of(const Prepared& prepared);

/// Of a motion, and for columns without an exact derivative, predict() gives none.
std::unique_ptr<CalibrationExperiment> run_experiment(const Prepared& prepared,
                                                      const std::vector<CalibrationUnknown>& unknowns,
                                                      CalibrationTarget target, const RunOptions& options);

}  // namespace genu
