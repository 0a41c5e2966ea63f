// What a pose that nobody solved lacks to be an equilibrium.
//
// Ligaments, elastic layers, loads, weights and joint springs act as they are; rigid contacts, prescribed coordinates
// and what joints hold would have to carry the rest.
#pragma once

#include <optional>
#include <vector>

#include "genu/model/linearization.h"

namespace genu {

struct Unbalanced {
  /// The wrench that has to be added on each moving body, joint by joint what balances it: [force, moment about the
  /// body's own origin in the file], N and N m, in the body's axes.
  std::vector<Vec6> wrenches;
  /// The same as generalised moments and forces (N m, N) on every coordinate of every joint, those that joints hold
  /// among them; empty where a joint is at its gimbal pose.
  std::optional<std::vector<JointValues>> forces;
  /// How finely each elastic layer had to be summed for its tolerance (State::layer_levels).
  std::vector<int> layer_levels;
};

/// At a state, and the load factors and time of `target`; what it prescribes, the state's contacts and multipliers do
/// not matter. `memory` makes the next pose faster.
Unbalanced unbalanced(const JointModel& model, State state, Target target, Linearization& memory);

}  // namespace genu
