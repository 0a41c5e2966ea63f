// Feasible directions under unilateral constraints, for motions and for forces.
#pragma once

#include "genu/core/types.h"

namespace genu {

/// Whether bounds * motion <= 0 (bounds: k x n, rows of norm <= 1; motion: n), up to rounding of 1e-9 |motion|.
bool within(const MatX& bounds, const VecX& motion);

/// A feasible direction among `motions` (n x m, columns) that moves away from at least one bound, of unit norm where
/// the columns are orthonormal. Zeros where there is none. With R = bounds * motions, rows scaled to norm 1, it is -R^T
/// y for the y >= 1 that minimises |R^T y|. By Stiemke's theorem that minimum is 0 exactly where no such motion exists.
/// The result has been checked against the bounds and moves away from one by more than 1e-6 of its norm.
VecX feasible_direction(const MatX& bounds, const MatX& motions);

/// A strictly feasible direction: it moves away from every bound (zero rows excepted) by more than 1e-9 of its norm.
/// Zeros where there is none. It is opposite to the point nearest to 0 in the convex hull of the rows of R (scaled to
/// norm 1). By Gordan's theorem it exists unless that point is 0.
VecX interior_direction(const MatX& bounds, const MatX& motions);

/// The y >= 0 that minimises |A y - b|, by Lawson and Hanson's method.
VecX nonnegative_least_squares(const MatX& A, const VecX& b);

}  // namespace genu
