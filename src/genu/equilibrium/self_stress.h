// Forces that could be others, though those that are held look determined. Contacts that touch and carry nothing:
// between four feet of a stool a load is shared in many ways, in some of which one carries nothing; such a foot opens
// at gap 0. And four that are all held share a load over the line between two of them in one way only. Ligaments at a
// length where their force jumps up, unless that length is prescribed: it could be any between.
#pragma once

#include "genu/equilibrium/active_set.h"
#include "genu/equilibrium/stability.h"

namespace genu {

/// Looks at a solved pose, whose `stability` is known, where forces can be traded, surfaces touch and no contact is
/// held, a ligament stands at a jump of its force, or Newton's method has come no nearer than what rows are then known
/// to (PoseAccuracy::of_rows). Of all trades those count in which no contact without force would pull, and no ligament
/// would leave its jump. Stability::redundant names what takes part in them; what of that is not held becomes contacts
/// of `pose` without force, and ligaments held at their jumps.
void find_self_stress(ActiveSetSolver& solver, const Target& target, const Certificate& certificate, Balanced& pose,
                      Stability& stability);

}  // namespace genu
