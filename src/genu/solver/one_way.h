// Motions that are held one way only, or less one way than the other: a contact that carries nothing presses back and
// does not pull, a ligament that is about to become taut pulls back and does not push, beyond the stop of a joint or
// the end of a load's scale the stiffness is another. The tangent stiffness, which holds such a contact closed and
// takes the side of the others that rounding has put the pose on, calls stable what falls away the other way, or goes
// there for nothing.
#pragma once

#include <vector>

#include "genu/solver/stability.h"

namespace genu {

/// Looks at a solved pose, whose `stability` is that of its tangent stiffness, where contacts, layers or ligaments
/// exert no more than fails to balance, or where it is no farther from a kink (kinks.h) than it is from the pose that
/// is meant, by what Newton's method would still correct. `stability` becomes what holds then, Stability::one_way: the
/// least that a motion costs, each contact closed or opening, on whichever side of each kink the motion is
/// (one_sided.h). Where that is nothing, the motion is Stability::neutral and the smallest eigenvalue 0. Layers, and
/// laws that begin with a toe, hold nothing either way: to first order. `layer_loads` (N), of this pose or one beside
/// it, and a look at each kink tell whether there is anything of that; it is all it costs elsewhere.
void look_one_way(const JointModel& model, const State& state, const Target& target,
                  const std::vector<double>& layer_loads, Stability& stability);

}  // namespace genu
