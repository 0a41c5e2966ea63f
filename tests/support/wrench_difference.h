// Finite differences along twists, for wrenches and gradients that depend on the poses of two bodies; and random poses.
#pragma once

#include <algorithm>
#include <random>

#include "genu/core/pose.h"
#include "genu/core/types.h"

namespace genu::test {

/// A pose with a rotation from all of SO(3) and an origin in [-reach, reach]^3.
inline Pose random_pose(std::mt19937& generator, double reach) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return Vec3{unit(generator), unit(generator), unit(generator)}; };
  return {exp_rotation(3 * vector()), reach * vector()};
}

/// d f / d [twist of A; twist of B], one column a twist component, for f(X_WA, X_WB) -> VecX.
/// Central differences with Richardson's extrapolation: truncation O(h^4), rounding about 1e-16 |f| / h.
template <typename Function>
MatX twist_difference(const Function& f, const Pose& X_WA, const Pose& X_WB, double h = 1e-3) {
  const auto at = [&](int column, double step) -> VecX {
    Vec6 twist = Vec6::Zero();
    twist[column % 6] = step;
    return column < 6 ? f(retract(X_WA, twist), X_WB) : f(X_WA, retract(X_WB, twist));
  };
  MatX out(VecX(f(X_WA, X_WB)).size(), 12);
  for (int c = 0; c < 12; ++c) out.col(c) = (8 * (at(c, h) - at(c, -h)) - (at(c, 2 * h) - at(c, -2 * h))) / (12 * h);
  return out;
}

/// Largest difference of two matrices relative to the larger of the exact one's largest entry and `floor`.
inline double relative_error(const MatX& exact, const MatX& difference, double floor = 1e-12) {
  return (exact - difference).cwiseAbs().maxCoeff() / std::max(exact.cwiseAbs().maxCoeff(), floor);
}

}  // namespace genu::test
