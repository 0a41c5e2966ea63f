// The columns of results.csv and events.csv (docs/scene-reference.md) from solved poses.
#pragma once

#include <optional>
#include <vector>

#include "genu/model/layer_report.h"
#include "genu/path/path_options.h"
#include "genu/results/result_table.h"

namespace genu {

/// A pose and what only the surfaces could tell about it.
struct PoseRecord {
  PosePoint point;
  std::vector<double> pair_gap;  ///< m, of each contact pair: the smallest gap; empty for a pose that was not solved
  std::vector<LayerReport> layers = {};  ///< of each elastic layer, where solving the pose has shown it
  /// Of a pose that was given, not solved: nobody knows the forces of its rigid contacts, its stability or residual.
  struct Given {
    std::vector<Vec6> missing;  ///< of each moving body: Unbalanced::wrenches
    bool reactions = false;     ///< the state's multipliers are what the pose would need
  };
  std::optional<Given> given = {};
};

/// One row a pose; columns BODY.residual_force_x_N ... where poses were given. Lengths in mm, angles in deg whatever
/// the scene's units are.
ResultTable pose_table(const PlacedScene& scene, const JointModel& model, const std::vector<StepPlan>& steps,
                       const std::vector<PoseRecord>& records);

/// One row an event, with the prescribed coordinates and load factors where it happened.
ResultTable event_table(const PlacedScene& scene, const std::vector<StepPlan>& steps,
                        const std::vector<PathEvent>& events);

}  // namespace genu
