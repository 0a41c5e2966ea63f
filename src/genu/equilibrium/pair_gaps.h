// The smallest gap of each rigid pair, for results.
#pragma once

#include <vector>

#include "genu/equilibrium/active_set.h"

namespace genu {

/// m; of held contacts, else looked for over the whole of both surfaces. `open`: contacts that were held once and are
/// followed, which are minima; where a pair has come nearer elsewhere since, that place takes the place of the lowest
/// of them, and of all where it is at a rim.
std::vector<double> pair_gaps(const State& state, const JointModel& model, ContactField& field,
                              std::vector<OpenContact>& open);

}  // namespace genu
