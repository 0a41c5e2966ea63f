// A seed that ends at a stable pose: on the elastic foundation of stiffness_homotopy.h every step does work against no
// force. Newton's method goes to the nearest equilibrium of any kind, and between two stable poses that is often the
// unstable one.
//
// On an orthonormal basis Z of the motions that the constraints leave free, in the metric of the characteristic length,
// each step is Z V |E|^-1 V^T Z^T w with V E V^T the symmetric part of Z^T K Z and its eigenvalues' sizes kept from 0
// (J. Nocedal, S. Wright, Numerical Optimization, 2nd ed. 2006, section 3.4): a step down even where the pose is
// unstable. A step that has climbed at its end is shortened. Only forces decide, so that loads without a potential do
// no harm.
#pragma once

#include "genu/equilibrium/stiffness_homotopy.h"

namespace genu {

/// How long its steps may be: long ones may leap from one valley into another; short ones follow where things would
/// slide, and take longer.
enum class Stride { usual, careful };

/// As stiffness_homotopy(). Where nothing holds a body the descent has no end: not balanced.
SeedReport descent_seed(const JointModel& model, ContactField& field, const Target& target, State& state,
                        Stride stride = Stride::usual, const Cancelled& cancelled = {});

}  // namespace genu
