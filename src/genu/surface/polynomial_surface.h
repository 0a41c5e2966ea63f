// Polynomials in two variables with their derivatives, and the descent to the closest point of a surface that a chart
// (u, v) -> p describes. Used by the polynomial surfaces of analytic.h.
#pragma once

#include <vector>

#include "genu/surface/analytic.h"

namespace genu {

/// Value and derivatives of a function of (x, y) up to second order.
struct PolynomialJet {
  double f = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

/// sum c x^i y^j, evaluated by Horner's rule without allocation.
class Polynomial {
 public:
  /// Terms with the same exponents add up. Exponents must lie in 0..kMaxPolynomialExponent.
  explicit Polynomial(const std::vector<PolynomialTerm>& terms);
  PolynomialJet operator()(double x, double y) const;
  double value(double x, double y) const;
  /// Does f depend on x at all?
  bool depends_on_x() const { return rows_ > 1; }

 private:
  int rows_ = 1, columns_ = 1;
  std::vector<double> c_;     ///< c of x^i y^j at [i * columns_ + j]
  std::vector<int> lengths_;  ///< of each row: after it there are zeros
};

/// Position and derivatives of a chart at (u, v); p in m, the derivatives per unit of u and v.
struct ChartJet {
  Vec3 p, u, v, uu, uv, vv;
};

/// Normal u x v, tangent basis with T.col(0) along u, and shape operator from the second fundamental form.
SurfacePoint surface_point(const ChartJet& jet);

}  // namespace genu
