// The columns of results.csv and events.csv (docs/scene-reference.md) from solved poses.
#pragma once

#include "genu/results/result_table.h"
#include "genu/solver/path.h"

namespace genu {

/// A pose and what only the surfaces could tell about it.
struct PoseRecord {
  PosePoint point;
  std::vector<double> pair_gap;  ///< m, of each contact pair: the smallest gap; empty for a pose that was not solved
};

/// One row a pose. Lengths in mm, angles in deg whatever the scene's units are.
ResultTable pose_table(const Scene& scene, const JointModel& model, const std::vector<StepPlan>& steps,
                       const std::vector<PoseRecord>& records);

/// One row an event, with the prescribed coordinates and load factors where it happened.
ResultTable event_table(const Scene& scene, const std::vector<StepPlan>& steps, const std::vector<PathEvent>& events);

}  // namespace genu
