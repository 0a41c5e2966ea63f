#include "genu/contact/layer_law.h"

#include <cmath>

#include "genu/contact/tolerances.h"

namespace genu {

LayerLaw::Pressure LayerLaw::at(double d, double h) const {
  if (kind == Kind::linear) return {confined_modulus * d / h, confined_modulus / h};
  const double e = d / h;
  if (e <= kMaxCompression) return {-confined_modulus * std::log1p(-e), confined_modulus / h / (1 - e)};
  const double slope = confined_modulus / (1 - kMaxCompression);
  return {slope * (e - kMaxCompression) - confined_modulus * std::log1p(-kMaxCompression), slope / h};
}

}  // namespace genu
