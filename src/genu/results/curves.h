// curves.svg: what a run found, to look at. Rotations, translations, contact forces, reactions, ligament forces and the
// smallest eigenvalue over the coordinate that was prescribed.
#pragma once

#include "genu/path/path_options.h"
#include "genu/results/chart.h"
#include "genu/results/result_table.h"

namespace genu {

/// The chart of a run. `poses` is its pose_table(), whose columns it reads. The x axis is the first prescribed
/// coordinate that runs from row to row in one direction, else the number of the row (from 1). `bars`, where given, are
/// the error_bars() of `poses` and are drawn as bands.
Chart curves(const PlacedScene& scene, const std::vector<StepPlan>& steps, const ResultTable& poses,
             const std::vector<PathEvent>& events, const ResultTable* bars = nullptr);

}  // namespace genu
