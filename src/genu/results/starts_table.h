// starts.csv: the equilibria that were found from several starts.
#pragma once

#include "genu/path/starts.h"
#include "genu/results/result_table.h"

namespace genu {

/// One row for each distinct equilibrium, then one for each start that found none.
ResultTable starts_table(const PlacedScene& scene, const JointModel& model, const StartSearch& search);

}  // namespace genu
