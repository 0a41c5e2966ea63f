// Polynomials in two variables with their derivatives.
//
// Horner's rule in y for the coefficient of each power of x, four powers at a time, and then in x. Zeros fill up the
// last four and the shorter of them: they change no bit, and neither does AVX2, which is used where the processor has
// it.
#pragma once

#include <vector>

#include "genu/surface/analytic.h"

namespace genu {

/// Value and derivatives of a function of (x, y) up to second order.
struct PolynomialJet {
  double f = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

/// sum c x^i y^j, evaluated without allocation.
class Polynomial {
 public:
  /// Terms with the same exponents add up. Exponents must lie in 0..kMaxPolynomialExponent.
  explicit Polynomial(const std::vector<PolynomialTerm>& terms);
  PolynomialJet operator()(double x, double y) const;
  double value(double x, double y) const;
  /// Does f depend on x at all?
  bool depends_on_x() const { return rows_ > 1; }

  /// The same without AVX2, for tests.
  PolynomialJet jet_anywhere(double x, double y) const;

 private:
  int rows_ = 1;              ///< powers of x
  std::vector<double> c_;     ///< four powers of x after four: for each power of y their four coefficients
  std::vector<int> lengths_;  ///< of each four: powers of y
};

}  // namespace genu
