// Ligaments and cables that would be shorter round another side of their surfaces. A path keeps the side on which it
// began; where another one has become shorter, the user may have meant that.
#pragma once

#include <string>
#include <vector>

#include "genu/model/joint_model.h"
#include "genu/results/pose_table.h"

namespace genu {

/// One sentence for each such path without a given side, at the first of the rows looked at where that is so.
std::vector<std::string> shorter_sides(const JointModel& model, const std::vector<PoseRecord>& records);

}  // namespace genu
