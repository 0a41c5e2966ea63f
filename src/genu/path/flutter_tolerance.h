// How near the beginning of a flutter is located.
#pragma once

#include <algorithm>

#include "genu/model/joint_model.h"
#include "genu/path/tolerances.h"

namespace genu {

/// `event_tolerance`, in the parameter of a substep, whose length is `substep`. The stiffness of elastic layers jumps
/// wherever a ray passes an edge, so that nothing finer than a share of the substep can be told of eigenvalues that
/// meet.
inline double flutter_tolerance(const JointModel& model, double event_tolerance, double substep) {
  return model.layers.empty() ? event_tolerance : std::max(event_tolerance, kFlutterShare * substep);
}

}  // namespace genu
