// The columns of results.csv of a motion over time (docs/scene-reference.md).
#pragma once

#include <vector>

#include "genu/motion/motion.h"
#include "genu/results/result_table.h"

namespace genu {

/// One row a point. `status` of all is ok.
ResultTable motion_table(const PlacedScene& scene, const JointModel& model, const std::vector<MotionPoint>& points);

/// J: how far the sum of all energies and works at a point is off that at the first.
double energy_error(const JointModel& model, const MotionPoint& first, const MotionPoint& point);

}  // namespace genu
