// The smallest gap of each rigid pair, for results.
#pragma once

#include <vector>

#include "genu/solver/contact_set.h"

namespace genu {

/// m; of held contacts and of open ones that are followed, else looked for over the whole of both surfaces.
std::vector<double> pair_gaps(const State& state, const std::vector<OpenContact>& open, const JointModel& model,
                              ContactField& field);

}  // namespace genu
