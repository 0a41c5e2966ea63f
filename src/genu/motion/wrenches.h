// The forces of a state in motion alone, without their derivatives: what a motion that is stepped explicitly needs.
#pragma once

#include <vector>

#include "genu/model/damping.h"

namespace genu {

/// Adds what ligaments and their dampers (in these modes) exert on the moving bodies to `wrench` (6 each: N, N m about
/// their origins, world axes). Returns what the dampers take, W.
double add_ligament_wrenches(const JointModel& model, const State& state, const std::vector<DamperMode>& modes,
                             const VecX& twist, VecX& wrench);

/// Adds loads on bodies, those on coordinates left out. Returns what they do, W.
double add_load_wrenches(const JointModel& model, const State& state, const Target& target, const VecX& twist,
                         VecX& wrench);

/// Adds weights.
void add_weight_wrenches(const JointModel& model, const State& state, VecX& wrench);

}  // namespace genu
