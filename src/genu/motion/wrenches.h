// Forces of a state in motion without derivatives, for explicit time steps.
#pragma once

#include <vector>

#include "genu/model/damping.h"

namespace genu {

/// Adds the wrenches of ligaments and their dampers (in these modes) on the moving bodies to `wrench` (6 each: N, N m
/// about their origins, world axes). Returns the power dissipated by dampers, W.
double add_ligament_wrenches(const JointModel& model, const State& state, const std::vector<DamperMode>& modes,
                             const VecX& twist, VecX& wrench);

/// Adds loads on bodies, without those on coordinates. Returns their power, W.
double add_load_wrenches(const JointModel& model, const State& state, const Target& target, const VecX& twist,
                         VecX& wrench);

/// Adds weights.
void add_weight_wrenches(const JointModel& model, const State& state, VecX& wrench);

}  // namespace genu
