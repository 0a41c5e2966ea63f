#include "genu/surface/analytic.h"
#include "genu/surface/analytic_placed.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

/// Axis z: a tube of radius r round the circle of radius R. With e the direction away from the axis, e_phi the one
/// along the circle and the normal n = c e + s z, the principal directions are e_phi (curvature c / (R + r c): it
/// changes sign between the outer and the inner half) and c z - s e (curvature 1 / r).
struct Torus {
  static constexpr bool kUnbounded = false;
  static constexpr bool kKnowsDistance = true;
  double R, r;

  bool project(const Vec3& x, SurfacePoint& out) const {
    const double rho = x.head<2>().norm();
    if (!(rho > kAmbiguousShare * R) || !x.allFinite()) return false;
    const double tube = Vec2(rho - R, x.z()).norm();
    if (!(tube > kAmbiguousShare * r)) return false;
    const double ex = x.x() / rho, ey = x.y() / rho;
    const double c = (rho - R) / tube, s = x.z() / tube;
    const double around = R + r * c;  // distance of the foot point from the axis
    out.p = Vec3(around * ex, around * ey, r * s);
    out.n = Vec3(c * ex, c * ey, s);
    out.T.col(0) = Vec3(-ey, ex, 0);
    out.T.col(1) = Vec3(-s * ex, -s * ey, c);
    out.S << -c / around, 0, 0, -1 / r;
    return true;
  }

  /// Of the torus round the same circle through x.
  bool bending(const Vec3& x, const Vec3& t, Bending& out) const {
    const double rho = x.head<2>().norm();
    if (!(rho > kAmbiguousShare * R) || !x.allFinite()) return false;
    const double tube = Vec2(rho - R, x.z()).norm();
    if (!(tube > kAmbiguousShare * r)) return false;
    const double ex = x.x() / rho, ey = x.y() / rho, c = (rho - R) / tube, s = x.z() / tube;
    const double around = -ey * t.x() + ex * t.y(), up = c * t.z() - s * (ex * t.x() + ey * t.y());
    out.n = Vec3(c * ex, c * ey, s);
    out.normal_curvature = -c / rho * around * around - up * up / tube;
    out.gauss = c / (rho * tube);
    return true;
  }

  std::optional<double> gap(const Vec3& x) const { return Vec2(x.head<2>().norm() - R, x.z()).norm() - r; }

  Mesh start_mesh(double edge, const Vec3&, double) const {
    const double local = affordable_edge(graded_edge(edge, std::min(r, R - r)), 4 * kPi * kPi * R * r);
    // Rows are staggered by half an edge, so that only an even number of them closes round the tube.
    const int rows = 2 * std::max(3, static_cast<int>(std::lround(kPi * r / (kRowSpacing * local))));
    // As many divisions on every parallel: about `local` long in the mean, no longer than refine() lets pass on the
    // outer equator, and not below half of that on the inner one (from R < 3 r on, refine() has to split).
    constexpr double kLongestParallel = 1.3;
    const double radius = std::min(std::max(R, (R + r) / kLongestParallel), 2 * (R - r) / kLongestParallel);
    const int around = grid_count(2 * kPi * radius, local);
    return grid_mesh({around, true}, {rows, true}, [&](double u, double v) {
      const double phi = 2 * kPi * u, theta = 2 * kPi * v;
      const double distance = R + r * std::cos(theta);
      return Vec3(distance * std::cos(phi), distance * std::sin(phi), r * std::sin(theta));
    });
  }
};

}  // namespace

std::unique_ptr<Surface> make_torus(const Pose& X_BS, double major_radius, double minor_radius, bool inside) {
  if (!is_radius(major_radius) || !is_radius(minor_radius) || minor_radius >= major_radius) return nullptr;
  return std::make_unique<Placed<Torus>>(X_BS, inside, Torus{major_radius, minor_radius});
}

}  // namespace genu
