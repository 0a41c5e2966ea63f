// Path following over the steps of a scene: tangent prediction, adaptive increments, contacts gained and lost at their
// events, and a certificate for every pose.
#pragma once

#include <string>
#include <vector>

#include "genu/path/path_options.h"

namespace genu {

/// Follows all steps from the reference pose. Poses go to the observer as they are solved, so none is lost if a later
/// one fails. A cancelled path ends within a pose, which is not reported. `from`: bytes saved by PathObserver::rest;
/// the continuation is the same to the last bit as without an interruption.
PathResult follow_path(const JointModel& model, ContactField& field, const std::vector<StepPlan>& steps,
                       const PathOptions& options, const PathObserver& observer, const std::string& from = {});

}  // namespace genu
