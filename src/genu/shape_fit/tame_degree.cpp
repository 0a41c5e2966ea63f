#include "genu/shape_fit/tame_degree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/shape_fit/tolerances.h"
#include "genu/surface/polynomial_surface.h"

namespace genu {
namespace {

bool is_tame(const Polynomial& P, const Polynomial& plain, const ChartBox& patch, bool cylindrical, double allowed) {
  const double least = cylindrical ? kMinRadiusShare * P.value(0, 0) : -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kLooksAcross; ++i) {
    for (int j = 0; j <= kLooksAcross; ++j) {
      const double u = patch.u0 + patch.width() * i / kLooksAcross, v = patch.v0 + patch.height() * j / kLooksAcross;
      const PolynomialJet h = P(u, v);
      const double along = cylindrical ? h.x / h.f : h.x;
      if (!(h.f > least) || !(1 / std::sqrt(1 + along * along + h.y * h.y) > kMinSlopeCosine)) return false;
      if (!(std::abs(h.f - plain.value(u, v)) <= allowed)) return false;
    }
  }
  return true;
}

}  // namespace

int highest_tame_degree(const PolynomialFit& fit, const std::vector<HeightSample>& samples, const ChartBox& patch,
                        bool cylindrical, int degree) {
  const Polynomial plain(fit.terms(std::min(2, fit.highest())));
  for (; degree > kLowestFitDegree; --degree) {
    const Polynomial P(fit.terms(degree));
    double allowed = kSwingAllowed;
    for (const HeightSample& s : samples)
      allowed = std::max(allowed, kSwingFactor * std::abs(P.value(s.u, s.v) - plain.value(s.u, s.v)));
    if (is_tame(P, plain, patch, cylindrical, allowed)) return degree;
  }
  return degree;
}

}  // namespace genu
