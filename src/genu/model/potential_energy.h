// The potential energy of a pose: energy stored in ligaments and joint springs, minus the work of the loads since the
// reference pose. At an equilibrium without constraints its derivative is 0; contacts and constraints do no work.
#pragma once

#include <optional>

#include "genu/model/state.h"

namespace genu {

/// Whether a load has a potential. It has: a force constant in the world, a force toward a point, a generalised force
/// on a coordinate. It has not: a follower, a moment constant in the world, a load scaled over a coordinate. A load
/// scaled over time has the potential of the moment.
bool has_potential(const Load& load);

/// J, in ligaments and joint springs.
double stored_energy(const JointModel& model, const State& state);

/// J, at the load factors and the time of `target`. Empty where an acting load has no potential, and with elastic
/// layers: their pressure acts along the normal of one surface and has no potential.
[[nodiscard]] std::optional<double> potential_energy(const JointModel& model, const State& state, const Target& target);

}  // namespace genu
