#include "genu/contact/layer_law.h"

#include <cmath>

#include "genu/contact/tolerances.h"

namespace genu {

LayerLaw::Pressure LayerLaw::at(double d, double h) const {
  if (kind == Kind::linear) return {confined_modulus * d / h, confined_modulus / h};
  const double e = d / h;
  const double sign = e < 0 ? -1.0 : 1.0, size = std::abs(e);
  if (size <= kMaxCompression) return {-sign * confined_modulus * std::log1p(-size), confined_modulus / h / (1 - size)};
  const double slope = confined_modulus / (1 - kMaxCompression);
  return {sign * (slope * (size - kMaxCompression) - confined_modulus * std::log1p(-kMaxCompression)), slope / h};
}

}  // namespace genu
