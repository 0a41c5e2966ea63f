// Sensitivity of loads to their own parameters at fixed poses.
#pragma once

#include "genu/model/load.h"
#include "genu/model/parameters.h"

namespace genu {

/// The change of a load per SI unit of one number, as a load: it has the changes of force, moment, value and points.
/// A load is affine in each number of its definition, so this is the load at 1 less the load at 0. For parameters of
/// loads but their factor, and of bodies, whose weights are loads.
Load load_change(const PlacedScene& scene, const Parameter& parameter);

/// The change of the wrench of `load` (as Load::between has it) where the load changes by `change`; for every kind but
/// a load on a coordinate.
Vec12 load_wrench_rate(const Load& load, const Load& change, const Pose& X_WA, const Pose& X_WB);

}  // namespace genu
