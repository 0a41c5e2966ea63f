// Tangent bases that differ from point to point, made comparable: finite differences along a surface need the basis
// that the derivatives assume, carried along by parallel transport.
#pragma once

#include <Eigen/Geometry>

#include "genu/surface/surface.h"

namespace genu::test {

/// `to` with its basis turned in its tangent plane into the one parallel-transported from `from`, nearby.
inline SurfacePoint transported(const SurfacePoint& from, SurfacePoint to) {
  const Mat32 T = Eigen::Quaterniond::FromTwoVectors(from.n, to.n).toRotationMatrix() * from.T;
  const Mat2 turn = T.transpose() * to.T;
  to.S = turn * to.S * turn.transpose();
  to.T = T;
  return to;
}

}  // namespace genu::test
