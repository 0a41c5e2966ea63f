// The smallest gap of each rigid pair, for results.
#pragma once

#include <vector>

#include "genu/equilibrium/active_set.h"

namespace genu {

/// Smallest gap of each rigid pair, m: of its active contacts, else the minimum over both surfaces. `open`: contacts
/// that were closed before and are followed. Where a pair has come closer at another place, that place replaces the
/// lowest of them; at a rim it replaces all.
std::vector<double> pair_gaps(const State& state, const JointModel& model, ContactField& field,
                              std::vector<OpenContact>& open);

}  // namespace genu
