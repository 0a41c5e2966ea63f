// What a solved path is worth: counts, certificate, doubts, and the sentences of the verdict.
#pragma once

#include "genu/assemble/prepare.h"
#include "genu/assemble/solution.h"
#include "genu/equilibrium/newton.h"
#include "genu/model/contact_field.h"

namespace genu {

/// `poses`: the pose_table() of what was solved. `newton`: for the loads that an overloaded layer would bear.
RunSummary appraise(const Prepared& prepared, ContactField& field, const Solved& solved, const ResultTable& poses,
                    const NewtonOptions& newton);

}  // namespace genu
