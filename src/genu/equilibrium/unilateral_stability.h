// Stability under unilateral constraints. A contact without force presses back and does not pull; a ligament about to
// become taut pulls and does not push; the stiffness changes beyond the stop of a joint and the end of a load's scale.
// The tangent stiffness keeps such a contact closed or ignores it, and takes whichever side of a nonsmooth point
// rounding gives. So it can call a pose stable that is free to move the other way, and unstable one that a contact
// blocks.
#pragma once

#include <vector>

#include "genu/equilibrium/stability.h"

namespace genu {

/// Acts where contacts, layers or ligaments exert no more force than the pose is known to, or where the pose cannot be
/// told from a nonsmooth point (release.h). `stability` then becomes the minimum cost of a motion, each contact closed
/// or opening, each nonsmooth point on the side that the motion takes (unilateral_stiffness.h); Stability::unilateral
/// is set. Where that cost is zero the motion is in Stability::neutral and the smallest eigenvalue is 0.
///
/// Laws with a toe and layers between nonconforming surfaces hold nothing in either direction to first order.
/// Stability::unknown_why is set where the answer depends on the extent of a contact without force along a line or an
/// area, or on a layer that presses at once.
///
/// `touching`: contacts at gap 0 without force that are not in `state`. `layer_loads` (N): of this pose or of one
/// beside it. `residual`: of the pose, scaled. These and the nearest nonsmooth points decide at little cost whether
/// anything applies.
void assess_unilateral_stability(const JointModel& model, const State& state,
                                 const std::vector<ActiveContact>& touching, const Target& target,
                                 const std::vector<double>& layer_loads, double residual, Stability& stability);

}  // namespace genu
