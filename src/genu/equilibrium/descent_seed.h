// A seed that ends at a stable pose: energy descent on the elastic foundation of stiffness_homotopy.h. Newton's method
// goes to the nearest equilibrium of any kind, and between two stable poses that is often the unstable one.
//
// Z: orthonormal basis of the motions that satisfy the constraints, in the metric of the characteristic length. Each
// step is Z V |E|^-1 V^T Z^T w, where V E V^T is the symmetric part of Z^T K Z and |E| is bounded away from 0 (J.
// Nocedal, S. Wright, Numerical Optimization, 2nd ed. 2006, section 3.4). It descends even where the pose is unstable.
// A step is shortened if the work along its end is negative. The method uses forces only, so loads without a potential
// are allowed.
#pragma once

#include "genu/equilibrium/stiffness_homotopy.h"

namespace genu {

/// Step length. Long steps may leap from one energy valley into another. Short ones follow a body as it slides, and
/// need more iterations.
enum class Stride { usual, careful };

/// As stiffness_homotopy(). Where nothing holds a body the descent does not end: not balanced.
SeedReport descent_seed(const JointModel& model, ContactField& field, const Target& target, State& state,
                        Stride stride = Stride::usual, const Cancelled& cancelled = {});

}  // namespace genu
