// The effects of a scene: what it names, which unknowns each brings, how often it was evaluated and for how long.
#pragma once

#include "genu/assemble/prepare.h"
#include "genu/results/summary.h"

namespace genu {

/// Counts begin at 0.
void start_counting(const Prepared& prepared);

/// Those that the scene names, with what has been counted since.
std::vector<RunSummary::Effect> effects_of(const Prepared& prepared);

}  // namespace genu
