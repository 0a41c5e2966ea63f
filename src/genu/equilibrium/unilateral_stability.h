// Motions that are held one way only, or less one way than the other: a contact that carries nothing presses back and
// does not pull, a ligament that is about to become taut pulls back and does not push, beyond the stop of a joint or
// the end of a load's scale the stiffness is another. The tangent stiffness, which holds such a contact closed or
// leaves it out, and takes the side of the others that rounding has put the pose on, calls stable what falls away the
// other way, or goes there for nothing, and unstable what is barred.
#pragma once

#include <vector>

#include "genu/equilibrium/stability.h"

namespace genu {

/// Looks at a solved pose, whose `stability` is that of its tangent stiffness, where contacts, layers or ligaments
/// exert no more than the pose is known to, or where it cannot be told from a kink (release.h). `stability` becomes
/// what holds then, Stability::unilateral: the least that a motion costs, each contact closed or opening, on whichever
/// side of each kink the motion is (unilateral_stiffness.h). Where that is nothing, the motion is Stability::neutral
/// and the smallest eigenvalue 0. Laws that begin with a toe, and layers between surfaces that do not conform, hold
/// nothing either way: to first order. Where what is barred depends on how far an idle contact reaches along a line or
/// an area, or on a layer that presses at once, and the answer with it, Stability::untold says so. `touching`: contacts
/// that are closed, carry nothing and are not of `state`. `layer_loads` (N), of this pose or one beside it, `residual`
/// (scaled) of the pose, and a look at each kink tell whether there is anything of that; it is all it costs elsewhere.
void assess_unilateral_stability(const JointModel& model, const State& state,
                                 const std::vector<ActiveContact>& touching, const Target& target,
                                 const std::vector<double>& layer_loads, double residual, Stability& stability);

}  // namespace genu
