// Integrals over the part of a curved triangle where a pressure is positive.
//
// The triangle is given by six nodes: its corners 0, 1, 2 and the middles of its edges 01, 12, 20. Place and pressure
// are quadratic in its parameters. It is divided twice, into 4 and into 16 triangles, over which the pressure is linear
// and cut off exactly at its zero line; both integrals are extrapolated (L. F. Richardson 1911), and their difference
// tells the error. They are C1 in the pressures, also where the triangle comes into contact as a whole.
#pragma once

#include <array>

#include "genu/core/types.h"

namespace genu {

using SixPlaces = std::array<Vec3, 6>;

/// Shape functions of the six nodes at the barycentric coordinates (1 - u - v, u, v).
inline Vec6 quadratic_shares(double u, double v) {
  const double w = 1 - u - v;
  Vec6 out;
  out << w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * w * u, 4 * u * v, 4 * v * w;
  return out;
}

/// For pressures p_j at the nodes: sum_j mass_ij p_j is the integral of the shape function i times the pressure, its
/// derivative to p_j is mass_ij, and share_i is the integral of the shape function over the part.
struct CellIntegrals {
  Mat6 mass = Mat6::Zero();   ///< m^2
  Vec6 share = Vec6::Zero();  ///< m^2
};

class QuadraticCell {
 public:
  enum class Part { none, some, whole };  ///< where the pressure is positive

  QuadraticCell() = default;
  /// `x`: places of the nodes, m.
  explicit QuadraticCell(const SixPlaces& x);

  /// Of the whole cell.
  const CellIntegrals& whole() const { return whole_; }
  /// Where the part is `some`, fills `out` with its integrals. `removed`: what extrapolation took from the load of
  /// the coarser division, N.
  Part integrate(const Vec6& p, CellIntegrals& out, double& removed) const;

 private:
  std::array<double, 20> areas_;  // m^2: of the 4 triangles, then of the 16
  CellIntegrals whole_;
  Vec6 removed_ = Vec6::Zero();  // by the pressures at the nodes, where all is in contact
};

}  // namespace genu
