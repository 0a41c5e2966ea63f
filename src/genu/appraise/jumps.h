// Where a joint jumped: steps between neighbouring rows that no path of equilibria connects.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/equilibrium/path_event.h"

namespace genu {

/// "the joint jumped 48.7 mm / 82.5 deg at knee.flexion = 18 deg; the poses after that belong to another position
/// (branch 2)" for each jump between rows, in order, the first few of many.
std::vector<std::string> jump_sentences(const Prepared& prepared, const std::vector<PathEvent>& events);

}  // namespace genu
