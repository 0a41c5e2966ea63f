#include "genu/surface/analytic.h"
#include "genu/surface/analytic_placed.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

struct Sphere {
  static constexpr bool kUnbounded = false;
  static constexpr bool kKnowsDistance = true;
  double radius;

  bool project(const Vec3& x, SurfacePoint& out) const {
    const double distance = x.norm();
    if (!(distance > kAmbiguousShare * radius) || !std::isfinite(distance)) return false;
    out.n = x / distance;
    out.p = radius * out.n;
    out.T = tangent_basis(out.n);
    out.S = Mat2::Identity() * (-1 / radius);
    return true;
  }

  Vec3 axis() const { return Vec3::Zero(); }

  std::optional<double> gap(const Vec3& x) const { return x.norm() - radius; }

  Mesh start_mesh(double edge, const Vec3&, double) const {
    return geodesic_mesh(Vec3::Constant(radius), affordable_edge(edge, 4 * kPi * radius * radius));
  }
};

}  // namespace

std::unique_ptr<Surface> make_sphere(const Pose& X_BS, double radius, bool inside) {
  if (!is_radius(radius)) return nullptr;
  return std::make_unique<Placed<Sphere>>(X_BS, inside, Sphere{radius});
}

}  // namespace genu
