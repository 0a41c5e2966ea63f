// A laxity table as the target of a calibration (laxity_target.h): at each flexion the neutral pose, then each test's
// loads outward in both directions, without the way back.
#pragma once

#include <memory>

#include "genu/calibrate/calibration_experiment.h"
#include "genu/calibrate/laxity_target.h"
#include "genu/core/cancelled.h"

namespace genu {

/// `knee`: of the scene with the loads of the tests; `compression` in N, at all poses.
std::unique_ptr<CalibrationExperiment> laxity_experiment(const LaxityJoint& knee,
                                                         const std::vector<CalibrationUnknown>& unknowns,
                                                         LaxityTarget target, double compression,
                                                         const Cancelled& cancelled);

}  // namespace genu
