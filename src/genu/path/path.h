// Pose after pose along the steps of a scene: prediction along the tangent, adaptive increments, contacts gained and
// lost where it happens, and every pose certified.
#pragma once

#include <string>
#include <vector>

#include "genu/path/path_options.h"

namespace genu {

/// Walks all steps from the reference pose. What was solved has been handed to the observer whatever happens later; a
/// path that is cancelled ends in the middle of a pose, of which nothing is told. `from`: what PathObserver::rest has
/// saved; what comes after it then is the same to the last bit as if it had never been interrupted.
PathResult follow_path(const JointModel& model, ContactField& field, const std::vector<StepPlan>& steps,
                       const PathOptions& options, const PathObserver& observer, const std::string& from = {});

}  // namespace genu
