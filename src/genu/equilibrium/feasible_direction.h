// Motions, or forces, that one-sided conditions leave.
#pragma once

#include "genu/core/types.h"

namespace genu {

/// Whether `motion` (n) has no positive product with any row of `bounds` (k x n, of norm 1 or less): by more than 1e-9
/// of its norm, which is rounding.
bool within(const MatX& bounds, const VecX& motion);

/// A motion among `motions` (n x m, columns) that leaves bounds and exceeds none, of unit norm where the columns are
/// orthonormal; of zeros where there is none. With R = bounds * motions, its rows of norm 1, it is -R^T y for the y >=
/// 1 that makes that least: 0 if R^T y = 0 for some y > 0, which by Stiemke's theorem is the case where no such motion
/// exists. What is returned has been held to the bounds, and leaves one by more than 1e-6 of its norm.
VecX feasible_direction(const MatX& bounds, const MatX& motions);

/// One that leaves all bounds (but those that no motion comes to) by more than 1e-9 of its norm; of zeros where there
/// is none. The rows of R, of norm 1, have a nearest point to 0 in their convex hull; the motion is opposite to it, and
/// exists, by Gordan's theorem, unless that point is 0.
VecX interior_direction(const MatX& bounds, const MatX& motions);

}  // namespace genu
