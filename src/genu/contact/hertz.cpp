#include "genu/contact/hertz.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "genu/contact/tolerances.h"

namespace genu {

/// By the arithmetic-geometric mean: quadratic convergence.
double carlson_rf0(double y, double z) {
  double a = std::sqrt(y), g = std::sqrt(z);
  for (int i = 0; i < kMaxMeanSteps && std::abs(a - g) > 1e-8 * a; ++i) {
    const double mean = 0.5 * (a + g);
    g = std::sqrt(a * g);
    a = mean;
  }
  return std::numbers::pi / (a + g);
}

/// Duplication until the arguments agree to 1 %, then Carlson's series of sixth order.
double carlson_rd0(double y, double z) {
  double x = 0, sum = 0, factor = 1, mean = 0.2 * (y + 3 * z);
  const double spread = std::max(std::abs(mean), std::max(std::abs(mean - y), std::abs(mean - z)));
  double left = spread;
  for (int i = 0; i < kMaxMeanSteps && left > kCarlsonSpread * mean; ++i) {
    const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z), lambda = rx * ry + rx * rz + ry * rz;
    sum += factor / (rz * (z + lambda));
    factor *= 0.25;
    x = 0.25 * (x + lambda), y = 0.25 * (y + lambda), z = 0.25 * (z + lambda), mean = 0.25 * (mean + lambda);
    left *= 0.25;
  }
  const double X = 1 - x / mean, Y = 1 - y / mean, Z = -(X + Y) / 3, xy = X * Y, zz = Z * Z;
  const double e2 = xy - 6 * zz, e3 = (3 * xy - 8 * zz) * Z, e4 = 3 * (xy - zz) * zz, e5 = xy * zz * Z;
  const double series = 1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52 + 3 * e5 / 26;
  return 3 * sum + factor * series / (mean * std::sqrt(mean));
}

HertzContact hertz(double least, double most, double reduced_modulus, double approach) {
  // With m1 = (b/a)^2, Johnson's equation 4.26 reads least/2 = p0/E* b/a^2 R_D(0, m1, 1)/3 and most/2 = p0/E* b/a^2
  // R_D(0, 1, m1)/3. Their ratio decreases from infinity to 1 as m1 grows to 1.
  const double ratio = most / least;
  double low = -80, high = 0;  // of ln m1
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high), m1 = std::exp(middle);
    (carlson_rd0(1, m1) > ratio * carlson_rd0(m1, 1) ? low : high) = middle;
  }
  const double m1 = std::exp(0.5 * (low + high)), K = carlson_rf0(m1, 1);
  HertzContact out;
  out.a = std::sqrt(2 * approach * carlson_rd0(m1, 1) / (3 * least * K));
  out.b = std::sqrt(m1) * out.a;
  out.peak_pressure = approach * reduced_modulus / (out.b * K);
  out.force = 2.0 / 3 * out.peak_pressure * std::numbers::pi * out.a * out.b;
  return out;
}

}  // namespace genu
