// The transition from the end of a step to the start of the next.
#pragma once

#include "genu/equilibrium/active_set.h"

namespace genu {

/// Balances `pose`, which was solved with the prescribed coordinates of the step before. A coordinate that is free from
/// now on may be far from equilibrium; no body passes through another on the way there. On failure `pose` is unchanged.
PoseReport settle_freed(ActiveSetSolver& solver, Balanced& pose, const Target& target);

}  // namespace genu
