#include "genu/shape_fit/tame_degree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/surface/polynomial_surface.h"

namespace genu {
namespace {

constexpr int kAcross = 40;               // points each way that are looked at, and both ends
constexpr double kSteepestSlope = 0.309;  // cos 72 deg
constexpr double kLeastRadius = 0.2;      // of the radius in the middle
constexpr double kSwings = 2;             // times what it does on the samples
constexpr double kAlwaysMay = 1e-4;       // m

bool is_tame(const Polynomial& P, const Polynomial& plain, const ChartBox& patch, bool cylindrical, double allowed) {
  const double least = cylindrical ? kLeastRadius * P.value(0, 0) : -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kAcross; ++i) {
    for (int j = 0; j <= kAcross; ++j) {
      const double u = patch.u0 + patch.width() * i / kAcross, v = patch.v0 + patch.height() * j / kAcross;
      const PolynomialJet h = P(u, v);
      const double along = cylindrical ? h.x / h.f : h.x;
      if (!(h.f > least) || !(1 / std::sqrt(1 + along * along + h.y * h.y) > kSteepestSlope)) return false;
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
    double allowed = kAlwaysMay;
    for (const HeightSample& s : samples)
      allowed = std::max(allowed, kSwings * std::abs(P.value(s.u, s.v) - plain.value(s.u, s.v)));
    if (is_tame(P, plain, patch, cylindrical, allowed)) return degree;
  }
  return degree;
}

}  // namespace genu
