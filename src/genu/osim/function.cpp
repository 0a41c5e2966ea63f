#include "genu/osim/function.h"

#include <algorithm>
#include <cstddef>

namespace genu::osim {
namespace {

using Numbers = std::vector<double>;

/// The cubic spline of Forsythe, Malcolm and Moler (Computer Methods for Mathematical Computations, 1977, section 4.4),
/// which OpenSim calls SimmSpline: the third derivatives at the ends are those of the cubics through the four outermost
/// points. y + d (b + d (c + d e)) with d = x - x_k.
struct SplinePieces {
  Numbers b, c, e;
};

SplinePieces pieces_of(const Numbers& x, const Numbers& y) {
  const std::size_t n = x.size(), last = n - 1;
  SplinePieces s{Numbers(n), Numbers(n), Numbers(n)};
  if (n == 2) {
    s.b[0] = s.b[1] = (y[1] - y[0]) / (x[1] - x[0]);
    return s;
  }
  auto& [b, c, e] = s;  // first the diagonal, the right side and the other diagonal of a tridiagonal system
  for (std::size_t i = 0; i < last; ++i) e[i] = x[i + 1] - x[i];
  c[1] = (y[1] - y[0]) / e[0];
  for (std::size_t i = 1; i < last; ++i) {
    b[i] = 2 * (e[i - 1] + e[i]);
    c[i + 1] = (y[i + 1] - y[i]) / e[i];
    c[i] = c[i + 1] - c[i];
  }
  b[0] = -e[0];
  b[last] = -e[last - 1];
  c[0] = c[last] = 0;
  if (n > 3) {
    c[0] = c[2] / (x[3] - x[1]) - c[1] / (x[2] - x[0]);
    c[last] = c[last - 1] / (x[last] - x[last - 2]) - c[last - 2] / (x[last - 1] - x[last - 3]);
    c[0] *= e[0] * e[0] / (x[3] - x[0]);
    c[last] *= -e[last - 1] * e[last - 1] / (x[last] - x[last - 3]);
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double t = e[i - 1] / b[i - 1];
    b[i] -= t * e[i - 1];
    c[i] -= t * c[i - 1];
  }
  c[last] /= b[last];
  for (std::size_t i = last; i-- > 0;) c[i] = (c[i] - e[i] * c[i + 1]) / b[i];
  b[last] = (y[last] - y[last - 1]) / e[last - 1] + e[last - 1] * (c[last - 1] + 2 * c[last]);
  for (std::size_t i = 0; i < last; ++i) {
    b[i] = (y[i + 1] - y[i]) / e[i] - e[i] * (c[i + 1] + 2 * c[i]);
    e[i] = (c[i + 1] - c[i]) / e[i];
    c[i] *= 3;
  }
  return s;
}

/// The last of the points that is not beyond `at`; the first where all are.
std::size_t piece_at(const Numbers& x, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  return above == x.begin() ? 0 : static_cast<std::size_t>(above - x.begin()) - 1;
}

double spline(const Numbers& x, const Numbers& y, double at) {
  const SplinePieces s = pieces_of(x, y);
  const std::size_t k = piece_at(x, at);
  const double d = at - x[k];
  if (at < x.front() || k + 1 == x.size()) return y[k] + d * s.b[k];
  return y[k] + d * (s.b[k] + d * (s.c[k] + d * s.e[k]));
}

double piecewise_linear(const Numbers& x, const Numbers& y, double at) {
  const std::size_t k = std::min(piece_at(x, at), x.size() - 2);
  return y[k] + (at - x[k]) * (y[k + 1] - y[k]) / (x[k + 1] - x[k]);
}

double polynomial(const Numbers& coefficients, double at) {
  double value = 0;
  for (const double c : coefficients) value = value * at + c;
  return value;
}

}  // namespace

double Function::operator()(double at) const {
  switch (kind) {
    case Kind::constant:
    case Kind::linear:
    case Kind::polynomial:
      return scale * polynomial(coefficients, at);
    case Kind::spline:
      return scale * spline(x, y, at);
    case Kind::piecewise_linear:
      return scale * piecewise_linear(x, y, at);
  }
  return 0;
}

}  // namespace genu::osim
