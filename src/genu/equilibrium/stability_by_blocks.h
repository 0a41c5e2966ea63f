// The stability of a stable equilibrium of many bodies, at a cost that grows with their number.
//
// Z^T K Z is positive definite where the matrix [K A^T; A 0], with the rows A of what is held, has as many negative
// eigenvalues as A has rows, which the pivots of its block LU tell. The smallest eigenvalue and its motion then follow
// by Lanczos' method with the inverse: what the factors solve.
#pragma once

#include <optional>

#include "genu/equilibrium/stability.h"

namespace genu {

/// assess_stability() of a pose whose smallest eigenvalue is certainly positive and whose stiffness is symmetric.
/// Nothing for every other pose, and where rows of what is held depend on each other.
std::optional<Stability> stable_by_blocks(const Linearization& at, double length_scale);

}  // namespace genu
