// A search for balance that ended with a body far away and nothing to stop it: the loads pull the joint apart.
#pragma once

#include <string>

#include "genu/model/contact_field.h"

namespace genu {

/// In words, of the body that went farthest from `start` to `ended`, where no surfaces touch at `ended`, no layer
/// presses and no ligament has a force; else empty. `ended` needs no contacts or multipliers.
std::string adrift(const JointModel& model, ContactField& field, const State& start, const State& ended);

}  // namespace genu
