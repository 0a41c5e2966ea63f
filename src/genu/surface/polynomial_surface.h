// The descent to the closest point of a surface that a chart (u, v) -> p describes. Used by the polynomial surfaces of
// analytic.h.
#pragma once

#include "genu/surface/analytic.h"
#include "genu/surface/polynomial.h"

namespace genu {

/// Position and derivatives of a chart at (u, v); p in m, the derivatives per unit of u and v.
struct ChartJet {
  Vec3 p, u, v, uu, uv, vv;
};

/// Normal u x v, tangent basis with T.col(0) along u, and shape operator from the second fundamental form.
SurfacePoint surface_point(const ChartJet& jet);

}  // namespace genu
