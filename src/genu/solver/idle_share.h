// Contacts that touch and carry nothing, of which a force could: between four feet of a stool a load is shared in many
// ways, in some of which one carries nothing. Such a foot opens at gap 0, and those that are left have forces that look
// determined. And four that are all held share a load over the line between two of them in one way only.
#pragma once

#include "genu/solver/contact_set.h"
#include "genu/solver/stability.h"

namespace genu {

/// Looks at a solved pose, whose `stability` is known, where forces can be traded or surfaces touch and no contact is
/// held (`touching`). Of all trades those count in which no contact without force would pull. Stability::redundant
/// names what takes part in them; the contacts among that which are not held become contacts of `pose` without force.
void share_with_idle(ContactSetSolver& solver, const Target& target, bool touching, Balanced& pose,
                     Stability& stability);

}  // namespace genu
