// How far a point in front of a polynomial patch surely is from it: without a search for the nearest point.
//
// In chart coordinates a point has the height h over the polynomial P, which goes on past the sides of its patch as it
// ends there. P rises by no more than L per length, so the patch is no nearer than
//
//   h / sqrt(1 + L^2),   L^2 = max P_x^2 + max P_y^2                        for z = P(x, y)
//                        L^2 = (k max |P_theta|)^2 / (rho min P) + max P_z^2   for r = P(theta, z), at the distance rho
//
// from the axis. k = (w / 2) / sin(w / 2), w the patch's angle: an arc against its chord, which is 2 sqrt(rho r)
// sin(angle / 2) where the radii are apart. Bounds of P and its derivatives are those of their Bernstein coefficients.
//
// The slope is that of the cells of the patch around x, as far as the distance is less than a cell's width, or else
// that of the whole patch. A point beside the patch is no nearer than the sides between which the patch lies.
#pragma once

#include <utility>
#include <vector>

#include "genu/surface/analytic.h"
#include "genu/surface/polynomial_surface.h"
#include "genu/surface/surface_chart.h"

namespace genu {

class FrontDistance {
 public:
  FrontDistance(const SurfaceChart& chart, const ChartBox& patch, const std::vector<PolynomialTerm>& terms,
                bool inside);

  /// m: a ball about x (in the body) that is smaller meets neither the patch nor what is over the patch behind it. 0
  /// where nothing is known: behind the patch.
  double operator()(const Vec3& x) const;

 private:
  struct Slopes {
    double along = 0;   // square of L, or of its part along the axis
    double around = 0;  // m: the square of k max |P_theta| / sqrt(min P)
  };
  double beside(const ChartPoint& c, double u, double v) const;
  double bound(double height, const Slopes& slopes, double rho) const;

  SurfaceChart chart_;
  ChartBox patch_;
  Polynomial P_;
  double side_;             // 1, or -1 where the outward side is down
  double end_u0_, end_u1_;  // rad, within half a turn: the patch's sides round an axis
  Slopes whole_;
  std::vector<Slopes> near_;           // of each cell and those beside it
  double cell_u_ = 0, cell_v_ = 0;     // m or rad, m
  double least_radius_ = 0, arc_ = 1;  // min P; k
  bool usable_ = true;
};

/// Least and largest Bernstein coefficient over a box: bounds of the polynomial there.
std::pair<double, double> polynomial_range(const std::vector<PolynomialTerm>& terms, const ChartBox& box);

}  // namespace genu
