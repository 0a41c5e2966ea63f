// Contact forces and multipliers to begin with, where nothing is known of them.
#pragma once

#include "genu/model/linearization.h"

namespace genu {

/// Sets the forces of all contacts of `state` and its multipliers to those that balance it best where it stands (least
/// squares of the scaled residual); a contact that would have to pull gets none. False where no contact presses.
bool guess_forces(const JointModel& model, const Target& target, State& state);

}  // namespace genu
