// How finely elastic layers are summed: as the error at a solved pose asks for.
#pragma once

#include "genu/model/linearization.h"

namespace genu {

/// Raises the level of each layer whose estimated error is above its tolerance at the state that `here` is of; never
/// lowers one. True where any was: the pose is then to be solved again. A layer that carries less than 1/100 of the
/// model's force scale is held to the error that would be allowed there.
bool raise_layer_levels(const JointModel& model, const Linearization& here, State& state);

}  // namespace genu
