// Motions that are held one way only: a contact that carries nothing presses back and does not pull, a ligament that is
// about to become taut pulls back and does not push. The tangent stiffness, which holds such a contact closed and takes
// such a ligament for taut, calls stable what falls away the other way, or goes there for nothing.
#pragma once

#include <vector>

#include "genu/solver/stability.h"

namespace genu {

/// Looks at a solved pose, whose `stability` is that of its tangent stiffness, with the contacts, layers and ligaments
/// let go that exert no more than fails to balance. Where a motion that neither presses those contacts nor stretches
/// those ligaments costs nothing, or less (single eigenvectors), `stability` becomes that: Stability::one_way, the
/// motion as Stability::mode, and where it costs nothing among Stability::neutral, with 0 for the smallest eigenvalue.
/// Layers, and laws that begin with a toe, hold nothing either way: to first order. `layer_loads` (N), of this pose or
/// one beside it, and a look at each ligament tell whether there is anything to let go; that is all it costs elsewhere.
void look_one_way(const JointModel& model, const State& state, const Target& target,
                  const std::vector<double>& layer_loads, Stability& stability);

}  // namespace genu
