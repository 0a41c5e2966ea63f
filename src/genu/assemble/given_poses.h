// Poses that somebody else found, as numbers.
#pragma once

#include <optional>
#include <vector>

#include "genu/assemble/pose_columns.h"
#include "genu/model/joint_coordinates.h"

namespace genu {

struct GivenPose {
  std::vector<JointValues> coordinates;  ///< of every joint, rad and m; what joints hold is where they hold it
  double time = 0;                       ///< s; NaN where the file has none
  std::vector<double> load_factors;      ///< of every load; 1 where the file has none
  int step = 1, increment = 0;           ///< as in an earlier run's results, else 1 and the number of the row from 0
};

struct GivenPoses {
  std::vector<GivenPose> poses;
  std::size_t left_out = 0;  ///< rows of an earlier run that hold no pose
};

/// Reads the cells that `columns` has matched. Words that are no numbers, numbers too large for a joint and a time that
/// does not grow are added to `out` with their places, and the result is empty.
[[nodiscard]] std::optional<GivenPoses> read_given_poses(const SceneTables& scene, const PoseFile& file,
                                                         const PoseColumns& columns, Diagnostics& out);

}  // namespace genu
