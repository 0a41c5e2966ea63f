#include "genu/surface/analytic.h"
#include "genu/surface/analytic_placed.h"

namespace genu {
namespace {

/// z = 0, outward +z.
struct Plane {
  static constexpr bool kUnbounded = true;
  static constexpr bool kKnowsDistance = true;

  bool project(const Vec3& x, SurfacePoint& out) const {
    out.p = Vec3(x.x(), x.y(), 0);
    out.n = Vec3::UnitZ();
    out.T.col(0) = Vec3::UnitX();
    out.T.col(1) = Vec3::UnitY();
    out.S.setZero();
    return x.allFinite();
  }

  std::optional<double> gap(const Vec3& x) const { return x.z(); }

  Mesh start_mesh(double edge, const Vec3& centre, double reach) const {
    const int n = grid_count(2 * reach, affordable_edge(edge, 4 * reach * reach));
    return grid_mesh({n, false}, {n, false}, [&](double s, double t) {
      return Vec3(centre.x() + reach * (2 * s - 1), centre.y() + reach * (2 * t - 1), 0);
    });
  }
};

}  // namespace

std::unique_ptr<Surface> make_plane(const Pose& X_BS, bool inside) {
  return std::make_unique<Placed<Plane>>(X_BS, inside, Plane{});
}

}  // namespace genu
