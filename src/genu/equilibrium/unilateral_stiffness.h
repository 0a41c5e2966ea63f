// Minimum cost of a motion for a piecewise linear stiffness: it changes across some planes through the pose, and
// motions may not cross others.
#pragma once

#include <cstddef>
#include <vector>

#include "genu/core/types.h"

namespace genu {

/// A plane row . x = 0 among d motions.
struct Side {
  VecX row;             ///< d, unit norm
  VecX below, above;    ///< d, J: the stiffness gains below * row^T where row . x < 0, above * row^T where row . x > 0
  bool closed = false;  ///< no motion may cross it; adds no stiffness
};

struct UnilateralStiffness {
  MatX stiffness;  ///< d x d, J: on an orthonormal basis of the motions that are free without the closed planes
  std::vector<Side> sides;
  double known_to = 0;     ///< J: eigenvalues below it are rounding
  double nothing = 1e-10;  ///< fraction of the largest eigenvalue below which one is rounding too
};

/// The softest eigenmotion: K x = cost x on the sides that x takes, or within closed planes that x lies in.
struct LeastCost {
  bool told = true;           ///< false: too many cases
  bool any = false;           ///< false: no motion is possible
  double cost = 0;            ///< J: the least real part that is not zero
  bool oscillates = false;    ///< it belongs to a complex pair
  bool complex_pair = false;  ///< some eigenvalue is complex
  VecX motion;                ///< d, unit norm
  MatX free;      ///< d x k: motions at no cost, each feasible at least one way, even where others cost less
  int cases = 0;  ///< number of combinations of sides examined
};

/// Branch and bound over the sides. A combination is dropped where no motion lies on those sides, or where its lower
/// bound, with undecided sides as soft as their softer side, exceeds a cost already found. Symmetric stiffness: `cost`
/// is the minimum of x . K(x) x. Otherwise it is the lowest eigenvalue over all sides; with a negative one the motion
/// grows.
LeastCost least_cost(UnilateralStiffness at);

/// A feasible motion among `motions` (columns, orthonormal), with either sign: bounds * x <= 0. One column if that is
/// feasible, else a combination. Size 0 where only 0 is feasible.
VecX allowed(const MatX& bounds, const MatX& motions);

}  // namespace genu
