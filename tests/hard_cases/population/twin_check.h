// Results of a comparable knee beside the energy twin's.
#pragma once

#include <string>

#include "hard_cases/population/knee_spec.h"
#include "hard_cases/population/run_table.h"

namespace genu::population {

struct TwinVerdict {
  int compared = 0;   ///< poses
  std::string wrong;  ///< empty where all agree
};

/// Stable poses must be found again from beside them, with their contact forces; unstable ones must be left; and where
/// genu finds no equilibrium any more the twin must not find one next to the last.
TwinVerdict compare_with_twin(const Knee& knee, const RunTable& results);

}  // namespace genu::population
