// What moves how fast, and what that costs: rates and energies of a state in motion. `twist` has 6 for each moving
// body.
#pragma once

#include "genu/model/state.h"

namespace genu {

/// How fast the coordinates of every joint change (rad/s, m/s).
std::vector<JointValues> coordinate_rates(const JointModel& model, const State& state, const VecX& twist);

/// J' v of each constraint, what is prescribed and what joints hold, in the order of linearize(): v^T H v with H its
/// second derivative (rad/s^2, m/s^2).
VecX centripetal_rates(const JointModel& model, const State& state, const Target& target, const VecX& twist);

/// What the external loads do, without weights, W.
double load_power(const JointModel& model, const State& state, const Target& target, const VecX& twist);

/// J. Stored: by ligaments and joint springs; gravity: since the reference pose.
struct MechanicalEnergy {
  double kinetic = 0, stored = 0, gravity = 0;
  double sum() const { return kinetic + stored + gravity; }
};
MechanicalEnergy mechanical_energy(const JointModel& model, const State& state, const VecX& twist);

}  // namespace genu
