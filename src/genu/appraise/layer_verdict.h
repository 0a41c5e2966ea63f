// What the poses of a scene with elastic layers are worth, in words.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

/// Sentences on layers too stiff for their mesh and on depths that their law or rays do not reach; empty where all is
/// well. `poses` is the pose_table() of the scene.
std::vector<std::string> layer_sentences(const PlacedScene& scene, const JointModel& model, const ResultTable& poses);

/// Adds what layer_doubts.h finds at the pose where the search starts and at some of the records.
void say_layer_doubts(const Prepared& prepared, const std::vector<PoseRecord>& records, std::vector<std::string>& out);

}  // namespace genu
