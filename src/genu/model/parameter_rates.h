// Derivative of the residual of a pose with respect to a parameter of the scene: dR/dp of R(x, p) = 0, at fixed poses,
// multipliers and surface coordinates.
#pragma once

#include "genu/contact/surface_change.h"
#include "genu/model/linearization.h"
#include "genu/model/parameters.h"

namespace genu {

/// The changes of the two surfaces of a contact pair, per SI unit of the parameter.
struct PairChange {
  SurfaceChange a, b;
  bool none = true;  ///< the parameter belongs to neither
};
PairChange pair_change(const PlacedScene& scene, const Parameter& parameter, int pair, const ContactGeometry& contact);

/// dR/dp per SI unit, equation by equation as in linearize(): sets `wrench`, `constraint` and the residuals of the
/// contacts of `out`; its derivatives do not change. NaN where the parameter has no derivative.
void residual_rate(const PlacedScene& scene, const JointModel& model, const State& state, const Target& target,
                   const Parameter& parameter, Linearization& out);

}  // namespace genu
