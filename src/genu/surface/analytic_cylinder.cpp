#include "genu/surface/analytic.h"
#include "genu/surface/analytic_placed.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

/// Axis z, without ends.
struct Cylinder {
  static constexpr bool kUnbounded = true;
  static constexpr bool kKnowsDistance = true;
  double radius;

  bool project(const Vec3& x, SurfacePoint& out) const {
    const double rho = std::hypot(x.x(), x.y());
    if (!(rho > kAmbiguousShare * radius) || !x.allFinite()) return false;
    const double c = x.x() / rho, s = x.y() / rho;
    out.n = Vec3(c, s, 0);
    out.p = Vec3(radius * c, radius * s, x.z());
    out.T.col(0) = Vec3(-s, c, 0);
    out.T.col(1) = Vec3::UnitZ();
    out.S << -1 / radius, 0, 0, 0;
    return true;
  }

  Vec3 axis() const { return Vec3::UnitZ(); }

  std::optional<double> gap(const Vec3& x) const { return std::hypot(x.x(), x.y()) - radius; }

  Mesh start_mesh(double edge, const Vec3& centre, double reach) const {
    const double local = affordable_edge(graded_edge(edge, radius), 4 * kPi * radius * reach);
    const int around = grid_count(2 * kPi * radius, local);
    const int along = grid_count(2 * reach, kRowSpacing * local);
    return grid_mesh({around, true}, {along, false}, [&](double s, double t) {
      const double phi = 2 * kPi * s;
      return Vec3(radius * std::cos(phi), radius * std::sin(phi), centre.z() + reach * (2 * t - 1));
    });
  }
};

}  // namespace

std::unique_ptr<Surface> make_cylinder(const Pose& X_BS, double radius, bool inside) {
  if (!is_radius(radius)) return nullptr;
  return std::make_unique<Placed<Cylinder>>(X_BS, inside, Cylinder{radius});
}

}  // namespace genu
