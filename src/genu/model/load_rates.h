// Sensitivity of loads to their own parameters at fixed poses.
#pragma once

#include "genu/model/load.h"
#include "genu/model/parameters.h"

namespace genu {

/// Derivative of a load's wrench with factor 1 (as in Load::between) per SI unit of one of its own parameters. For all
/// kinds except loads on a coordinate.
Vec12 load_wrench_rate(const Load& load, const Parameter& parameter, const Pose& X_WA, const Pose& X_WB);

}  // namespace genu
