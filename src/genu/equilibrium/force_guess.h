// Initial contact forces and multipliers where none are known.
#pragma once

#include "genu/model/linearization.h"

namespace genu {

/// Sets all contact forces and multipliers of `state` to those that minimise the scaled residual at its poses (least
/// squares). A contact that would have to pull gets zero. False where no contact presses.
bool guess_forces(const JointModel& model, const Target& target, State& state);

}  // namespace genu
