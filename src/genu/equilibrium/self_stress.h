// Statically indeterminate forces that the active set alone does not show. Contacts that touch without force: on a
// stool with four feet the load is shared in many ways, and in some of them one foot carries nothing and opens at gap
// 0. (Four active feet share a load above the line between two of them in one way only.) Ligaments at a length where
// their force jumps up, unless that length is prescribed: any force between is possible.
#pragma once

#include "genu/equilibrium/active_set.h"
#include "genu/equilibrium/stability.h"

namespace genu {

/// Searches a solved pose with known `stability` for self-stresses. It does so where self-stresses exist, where
/// surfaces touch without an active contact, where a ligament is at a jump of its force, or where the pose's residual
/// is above Newton's tolerance. Only self-stresses count in which no contact without force would pull and no ligament
/// would leave its jump. Stability::redundant lists the members. Touching places among them become contacts of `pose`
/// with force 0; ligaments become held at their jumps.
void find_self_stress(ActiveSetSolver& solver, const Target& target, const Certificate& certificate, Balanced& pose,
                      Stability& stability);

}  // namespace genu
