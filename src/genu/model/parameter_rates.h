// What a parameter of the scene changes in the equations of a pose, bodies, multipliers and surface coordinates held:
// dR/dp of R(x, p) = 0.
#pragma once

#include "genu/contact/surface_change.h"
#include "genu/model/linearization.h"
#include "genu/model/parameters.h"

namespace genu {

/// The two surfaces of a contact pair, per SI unit of the parameter.
struct PairChange {
  SurfaceChange a, b;
  bool none = true;  ///< the parameter belongs to neither
};
PairChange pair_change(const PlacedScene& scene, const Parameter& parameter, int pair, const ContactGeometry& contact);

/// dR/dp per SI unit, equation by equation as linearize() has them: `wrench`, `constraint` and the residuals of the
/// contacts of `out` are set, its derivatives are left alone. NaN where the parameter has no derivative.
void residual_rate(const PlacedScene& scene, const JointModel& model, const State& state, const Target& target,
                   const Parameter& parameter, Linearization& out);

}  // namespace genu
