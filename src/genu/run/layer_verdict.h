// What the poses of a scene with elastic layers are worth, in words.
#pragma once

#include <string>
#include <vector>

#include "genu/model/joint_model.h"
#include "genu/results/result_table.h"

namespace genu {

/// Sentences on layers too stiff for their mesh and on depths that their law or rays do not reach; empty where all is
/// well. `poses` is the pose_table() of the scene.
std::vector<std::string> layer_sentences(const Scene& scene, const JointModel& model, const ResultTable& poses);

}  // namespace genu
