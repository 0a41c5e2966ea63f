// Whether a joint on elastic layers has no first pose because its loads are more than the layers carry.
#pragma once

#include "genu/assemble/prepare.h"
#include "genu/equilibrium/newton.h"

namespace genu {

/// The part of the loads under which the first pose of the first step balances where it does not under all of them:
/// 0.3, 0.1, 0.03 or 0.01. 0 where it does under none of these, and where the scene has no layer or no load there.
double bearable_loads(const Prepared& prepared, ContactField& field, const NewtonOptions& options);

}  // namespace genu
