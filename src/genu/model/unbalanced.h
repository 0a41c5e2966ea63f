// The forces missing for equilibrium at a pose that was not solved.
//
// Ligaments, elastic layers, loads, weights and joint springs act as usual. Rigid contacts, prescribed coordinates and
// joint reactions would have to carry the result.
#pragma once

#include <optional>
#include <vector>

#include "genu/model/linearization.h"

namespace genu {

struct Unbalanced {
  /// The wrench to be added on each moving body for equilibrium: [force, moment about the body's own origin in the
  /// file], N and N m, in the body's axes.
  std::vector<Vec6> wrenches;
  /// The same as generalised moments and forces (N m, N) on every coordinate of every joint, including those that
  /// joints hold. Empty where a joint is at its gimbal pose.
  std::optional<std::vector<JointValues>> forces;
  /// Refinement level that each elastic layer needed for its tolerance (State::layer_levels).
  std::vector<int> layer_levels;
};

/// At a state, with the load factors and time of `target`. Prescribed values, contacts and multipliers are ignored.
/// `memory` speeds up the next pose.
Unbalanced unbalanced(const JointModel& model, State state, Target target, Linearization& memory);

}  // namespace genu
