#include "genu/sweep/distribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "genu/sweep/normal_quantile.h"
#include "genu/sweep/tolerances.h"

namespace genu {
namespace {

/// Of a normal number between its bounds; the tail with more digits is used.
double normal_between(const Distribution& d, double low, double high, double u) {
  const double a = normal_probability((low - d.mean) / d.sd), b = normal_probability((high - d.mean) / d.sd);
  const double a_above = normal_probability((d.mean - low) / d.sd),
               b_above = normal_probability((d.mean - high) / d.sd);
  const double below = a + u * (b - a), above = b_above + (1 - u) * (a_above - b_above);
  const double z = below < above ? normal_quantile(below) : -normal_quantile(above);
  return std::clamp(d.mean + d.sd * z, low, high);
}

double one_of(const Distribution& d, double u) {
  const double all = std::accumulate(d.weights.begin(), d.weights.end(), 0.0);
  double sum = 0;
  for (std::size_t k = 0; k + 1 < d.values.size(); ++k) {
    sum += d.weights[k];
    if (u * all < sum) return d.values[k];
  }
  return d.values.back();
}

}  // namespace

double Distribution::quantile(double u) const {
  switch (kind) {
    case Kind::normal:
      return normal_between(*this, low, high, u);
    case Kind::lognormal:
      return std::clamp(std::exp(normal_between(*this, std::log(low), std::log(high), u)), low, high);
    case Kind::uniform:
      return low + u * (high - low);
    case Kind::values:
      return one_of(*this, u);
    case Kind::given:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double Distribution::smallest() const {
  return kind == Kind::values ? *std::min_element(values.begin(), values.end()) : quantile(kSmallestUnit);
}

Distribution lognormal(double mean, double sd) {
  Distribution d;
  d.kind = Distribution::Kind::lognormal;
  const double variance = std::log1p(std::pow(sd / mean, 2));
  d.mean = std::log(mean) - variance / 2;
  d.sd = std::sqrt(variance);
  d.low = 0;
  return d;
}

}  // namespace genu
