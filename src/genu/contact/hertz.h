// Contact of two elastic half spaces with a paraboloidal gap (Hertz 1882; Johnson 1985, section 4.2).
#pragma once

namespace genu {

struct HertzContact {
  double force = 0;          ///< N
  double peak_pressure = 0;  ///< Pa, at the centre (3/2 of the mean)
  double a = 0, b = 0;       ///< m: half axes of the contact area, a >= b, along the smaller and the larger curvature
};

/// For relative principal curvatures 0 < least <= most (1/m: the gap is (least x^2 + most y^2) / 2), the approach of
/// distant points (m), and 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 (Pa). Exact: elliptic integrals to rounding.
HertzContact hertz(double least, double most, double reduced_modulus, double approach);

/// Carlson's R_F(0, y, z) and R_D(0, y, z) for positive arguments (B. C. Carlson, Numer. Algorithms 10 (1995) 13-26).
/// With m1 = 1 - k^2 the complete elliptic integrals are K = R_F(0, m1, 1), K - E = k^2 R_D(0, m1, 1) / 3.
double carlson_rf0(double y, double z);
double carlson_rd0(double y, double z);

}  // namespace genu
