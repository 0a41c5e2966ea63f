// How loads change with the numbers that describe them, at bodies held still.
#pragma once

#include "genu/model/load.h"
#include "genu/model/parameters.h"

namespace genu {

/// The change of a load's wrench at the factor 1 (as Load::between has it) per SI unit of one of its own parameters;
/// for every kind but a load on a coordinate.
Vec12 load_wrench_rate(const Load& load, const Parameter& parameter, const Pose& X_WA, const Pose& X_WB);

}  // namespace genu
