// Pressure of an elastic layer on a rigid base against its depth: cartilage as a bed of springs across its thickness
// (elastic foundation; Johnson 1985, section 4.3, with the confined modulus of Blankevoort et al. 1991).
//
//     M = E (1 - nu) / ((1 + nu) (1 - 2 nu))       stiffness of a layer that cannot spread sideways, Pa
//     linear        p = M d / h                    depth d of both surfaces together over the thickness h of both
//     layers logarithmic   p = -M ln(1 - d / h)           true strain: stiffens as the layer is used up
#pragma once

namespace genu {

struct LayerLaw {
  enum class Kind { linear, logarithmic };
  Kind kind = Kind::linear;
  double confined_modulus = 0;  ///< M, Pa

  struct Pressure {
    double p = 0;      ///< Pa
    double slope = 0;  ///< dp/dd, Pa/m
  };

  /// At the depth d (m) of layers h (m) thick. Negative depths continue the formula: their pressure is negative.
  Pressure at(double d, double h) const;
};

/// M (Pa) from Young's modulus (Pa) and Poisson's ratio in [0, 0.5).
inline double confined_modulus(double young, double poisson) {
  return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
}

}  // namespace genu
