// Motions that are held one way only: a contact that carries nothing presses back and does not pull, a ligament that is
// about to become taut pulls back and does not push. The tangent stiffness, which holds such a contact closed and takes
// such a ligament for taut, calls stable what falls away the other way, or goes there for nothing.
#pragma once

#include <vector>

#include "genu/solver/stability.h"

namespace genu {

/// Looks at a solved pose, whose `stability` is that of its tangent stiffness, where contacts, layers or ligaments
/// exert no more than fails to balance. `stability` becomes what holds then, Stability::one_way: the least that a
/// motion costs, each of those contacts closed or opening, each of those ligaments shortening, kept or stretched,
/// whichever the motion does (of more than seven of them: all let go). Where that is nothing, the motion is
/// Stability::neutral and the smallest eigenvalue 0. Layers, and laws that begin with a toe, hold nothing either way:
/// to first order. `layer_loads` (N), of this pose or one beside it, and a look at each ligament tell whether there is
/// anything to let go; that is all it costs elsewhere.
void look_one_way(const JointModel& model, const State& state, const Target& target,
                  const std::vector<double>& layer_loads, Stability& stability);

}  // namespace genu
