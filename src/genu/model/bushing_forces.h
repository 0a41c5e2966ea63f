// The bushings of a model on its moving bodies.
#pragma once

#include "genu/model/joint_model.h"
#include "genu/model/state.h"

namespace genu {

/// Adds the wrenches of all bushings to those of the moving bodies, and unless null their derivative.
void add_bushings(const JointModel& model, const State& state, VecX& wrench, MatX* stiffness);

/// Adds the wrenches of their dampers in motion; returns the power that they take, W.
double add_bushing_dampers(const JointModel& model, const State& state, const VecX& twist, VecX& wrench);

}  // namespace genu
