// Rates, powers and energies of a state in motion. `twist`: 6 for each moving body.
#pragma once

#include "genu/model/state.h"

namespace genu {

/// Rates of the coordinates of every joint (rad/s, m/s).
std::vector<JointValues> coordinate_rates(const JointModel& model, const State& state, const VecX& twist);

/// J' v of each constraint (prescribed coordinates, coordinates held by joints), in the order of linearize(): v^T H v
/// with the Hessian H of the constraint (rad/s^2, m/s^2).
VecX centripetal_rates(const JointModel& model, const State& state, const Target& target, const VecX& twist);

/// Power of the external loads without weights, W.
double load_power(const JointModel& model, const State& state, const Target& target, const VecX& twist);

/// J. Stored: in ligaments and joint springs; gravity: since the reference pose.
struct MechanicalEnergy {
  double kinetic = 0, stored = 0, gravity = 0;
  double sum() const { return kinetic + stored + gravity; }
};
MechanicalEnergy mechanical_energy(const JointModel& model, const State& state, const VecX& twist);

}  // namespace genu
