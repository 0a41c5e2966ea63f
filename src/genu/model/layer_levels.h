// Refines the quadrature of elastic layers as the error at a solved pose requires.
#pragma once

#include "genu/model/linearization.h"

namespace genu {

/// N: the error that the tolerance of the k-th layer allows where it carries `load` (N). For a layer with less than
/// 1/100 of the model's force scale, the tolerance is taken of that force.
double allowed_error(const JointModel& model, std::size_t k, double load);

/// Raises the level of each layer whose estimated error exceeds its tolerance at the state of `here`; never lowers one.
/// True where any level rose: the pose must then be solved again.
bool raise_layer_levels(const JointModel& model, const Linearization& here, State& state);

}  // namespace genu
