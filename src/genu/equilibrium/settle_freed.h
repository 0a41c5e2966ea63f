// From the end of a step to the start of the next.
#pragma once

#include "genu/equilibrium/active_set.h"

namespace genu {

/// Balances `pose`, solved for what the step before prescribed: what is free from now on may be far from balance, and
/// comes to it through no body. On failure `pose` is left as it was.
PoseReport settle_freed(ActiveSetSolver& solver, Balanced& pose, const Target& target);

}  // namespace genu
