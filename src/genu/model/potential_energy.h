// The potential energy of a pose: what ligaments and joint springs store, less the work of the loads since the
// reference pose. At an equilibrium without constraints its derivative is 0; contact and constraints do no work.
#pragma once

#include <optional>

#include "genu/model/state.h"

namespace genu {

/// Whether a load has a potential: a force constant in the world, a force toward a point, a generalised force on a
/// coordinate; not a follower, a moment constant in the world, or a load scaled over a coordinate. A load scaled over
/// time has the one of the moment.
bool has_potential(const Load& load);

/// J, in ligaments and joint springs.
double stored_energy(const JointModel& model, const State& state);

/// J, at the load factors and the time of `target`; empty where a load that acts has no potential, and with elastic
/// layers: their pressure acts along the normal of one surface, which no energy is the source of.
std::optional<double> potential_energy(const JointModel& model, const State& state, const Target& target);

}  // namespace genu
