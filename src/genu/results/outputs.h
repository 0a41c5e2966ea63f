// The columns of results.csv that follow a parameter smoothly, and how fast.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "genu/equilibrium/sensitivity.h"
#include "genu/results/pose_table.h"

namespace genu {

struct Output {
  std::string column;  ///< as in results.csv
  std::string unit;    ///< as at its end: mm, deg, N, Nm; 1 where there is none
  double shown = 1;    ///< that unit per SI unit
  /// Its derivative, SI per SI unit of the parameter last given to `sensitivity`, at the pose it has factored; NaN
  /// where the pose has none (a contact that is not there).
  std::function<double(const PosePoint& point, const Sensitivity& sensitivity)> rate;
  int contact_number = 0;  ///< of columns of one contact among several of a pair (`medial.2.force_N`), else 0
};

/// In the order of pose_table(). Columns of single contacts are listed up to `contact_numbers` of each pair where that
/// is 2 or more.
std::vector<Output> outputs_of(const PlacedScene& scene, const JointModel& model, const std::vector<StepPlan>& steps,
                               int contact_numbers);

/// Why a column of results.csv has no exact derivative; empty for all others.
std::string why_not_smooth(const std::string& column);

}  // namespace genu
