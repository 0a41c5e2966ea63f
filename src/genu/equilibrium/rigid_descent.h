// Descent in energy between rigid surfaces: the way a joint without inertia takes from a pose that is no equilibrium to
// its next pose of rest. An elastic foundation (descent_seed.h) rests on samples of the surfaces, and where it is stiff
// it may hold a joint that slides; here contact is exact.
//
// Each step y (all bodies, in the metric of stability.h) minimises 1/2 y B y - w y, with the gaps of all places in
// reach, to first order, g + J y >= 0 and the constraints h + G y = 0. B = V max(|E|, b) V^T + d, where V E V^T is the
// symmetric part of the tangent stiffness with the curvature of contacts times their forces, and d is damping that
// limits the step: the implicit Euler step of a viscous motion. It is solved as a least distance problem by nonnegative
// least squares (C. Lawson, R. Hanson, Solving Least Squares Problems, 1974, chapter 23). Its multipliers are the
// contact forces. The method uses forces only, so loads without a potential are allowed.
#pragma once

#include <vector>

#include "genu/model/contact_field.h"

namespace genu {

struct RestReport {
  bool at_rest = false;
  bool over_edge = false;  ///< a contact has run off the edge of a surface
  int steps = 0;
  std::vector<Candidate> pressing;  ///< places with a force at rest
  std::vector<double> forces;       ///< N, of these
};

/// Moves the bodies of `state` to the next pose of rest, close enough for Newton's method. The state then has no
/// contacts. Not at rest where a body slides away or over an edge, or the surfaces leave no way.
RestReport slide_to_rest(const JointModel& model, ContactField& field, const Target& target, State& state,
                         const Cancelled& cancelled = {});

}  // namespace genu
