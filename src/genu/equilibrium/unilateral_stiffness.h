// The least that a motion costs where the stiffness is one on one side of some planes through the pose and another
// beyond them, and motions may not go beyond others.
#pragma once

#include <cstddef>
#include <vector>

#include "genu/core/types.h"

namespace genu {

/// A plane row . x = 0 among d motions.
struct Side {
  VecX row;             ///< d, unit norm
  VecX below, above;    ///< d, J: the stiffness gains below * row^T where row . x < 0, above * row^T beyond
  bool closed = false;  ///< no motion goes beyond, nothing is gained
};

struct UnilateralStiffness {
  MatX stiffness;  ///< d x d, J: an orthonormal basis of the motions that are free without the closed sides
  std::vector<Side> sides;
  double known_to = 0;     ///< J: eigenvalues below it are rounding
  double nothing = 1e-10;  ///< of the largest eigenvalue: those below it too
};

/// One motion that is as stiff as itself: K x = cost x on the side of every plane that it is on; or one within a closed
/// plane, in which that holds.
struct LeastCost {
  bool told = true;           ///< false: there are more cases than are looked at
  bool any = false;           ///< false: nothing can move
  double cost = 0;            ///< J: the least other than nothing; a real part
  bool oscillates = false;    ///< the least is that of a complex pair
  bool complex_pair = false;  ///< there is one somewhere
  VecX motion;                ///< d, unit norm
  MatX free;                  ///< d x k: motions that cost nothing, each at least one way, whatever costs less
  int cases = 0;              ///< combinations of sides that were looked at
};

/// What each side does is decided one after the other (branch and bound): a combination is given up where no motion
/// is on those sides, or where it would cost more than one that is known even if the undecided were as soft as on
/// their softer side. Symmetric stiffness: `cost` is the least of x . K(x) x. Otherwise the lowest of all motions that
/// are as stiff as themselves: one with a negative cost grows.
LeastCost least_cost(UnilateralStiffness at);

/// A motion among `motions` (columns, orthonormal) that no bound forbids, this way or the other: bounds * x <= 0. One
/// of them where that is so, else a sum; none (size 0) where all but 0 are forbidden.
VecX allowed(const MatX& bounds, const MatX& motions);

}  // namespace genu
