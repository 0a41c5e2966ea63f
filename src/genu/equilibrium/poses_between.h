// The straight way from one pose to another.
#pragma once

#include "genu/model/state.h"

namespace genu {

/// The poses at the share `u` of the straight way from one state to another; the rest of `out` stays.
void poses_between(const State& from, const State& to, double u, State& out);

}  // namespace genu
