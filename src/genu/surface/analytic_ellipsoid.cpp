#include "genu/surface/analytic.h"
#include "genu/surface/analytic_placed.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

/// (x/a)^2 + (y/b)^2 + (z/c)^2 = 1.
struct Ellipsoid {
  static constexpr bool kUnbounded = false;
  static constexpr bool kKnowsDistance = true;
  Vec3 a;

  // The foot point of x is p_i = a_i^2 x_i / (t + a_i^2), with t the root of |q(t)| = 1, q_i = a_i x_i / (t + a_i^2),
  // that lies right of the pole at -min a_i^2 (Eberly, "Distance from a point to an ellipse, an ellipsoid"). As in a
  // trust region's secular equation, 1/|q(t)| is increasing and concave there: Newton on 1/|q| - 1 arrives from the
  // left of the root and never passes it again, typically in three or four steps.
  bool solve_foot(const Vec3& x, double& t) const {
    const Vec3 a2 = a.cwiseAbs2();
    const double pole = -a2.minCoeff();
    // Each term alone reaches 1 here, so |q| >= 1: at or left of the root.
    const double left = (a.cwiseProduct(x.cwiseAbs()) - a2).maxCoeff();
    t = std::max(left, 0.0);
    for (int k = 0; k < kMaxEllipsoidSteps; ++k) {
      if (!(t - pole > kAmbiguousShare * -pole)) return false;  // x on the flat set of points with two feet
      const Vec3 d = a2 + Vec3::Constant(t);
      const Vec3 q = a.cwiseProduct(x).cwiseQuotient(d);
      const double q2 = q.squaredNorm();
      const double slope = q.cwiseAbs2().cwiseQuotient(d).sum();  // -(|q|^2)' / 2
      if (!(slope > 0) || !std::isfinite(slope)) return false;
      const double miss = std::sqrt(q2) - 1;
      // To the left of `left` only rounding, or one step from a start right of the root, can lead.
      t = std::max(t + miss * q2 / slope, left);
      if (std::abs(miss) <= kEllipsoidTolerance) return true;
    }
    return false;
  }

  bool project(const Vec3& x, SurfacePoint& out) const {
    double t = 0;
    if (!x.allFinite() || !solve_foot(x, t)) return false;
    const Vec3 a2 = a.cwiseAbs2();
    const Vec3 q = a.cwiseProduct(x).cwiseQuotient(a2 + Vec3::Constant(t)).normalized();
    out.p = a.cwiseProduct(q);
    const Vec3 gradient = q.cwiseQuotient(a);  // of f = (|q|^2 - 1) / 2, whose Hessian is diag(1 / a^2)
    const double length = gradient.norm();
    out.n = gradient / length;
    out.T = tangent_basis(out.n);
    out.S = out.T.transpose() * (-1 / length * a2.cwiseInverse()).asDiagonal() * out.T;
    out.S(1, 0) = out.S(0, 1);
    return true;
  }

  /// Of the similar ellipsoid through x: with D = diag(1 / a^2), n = D x / |D x|, the normal curvature is
  /// -t . D t / |D x|, and Gauss' is det D (x . D x) / |D x|^4.
  bool bending(const Vec3& x, const Vec3& t, Bending& out) const {
    const Vec3 D = a.cwiseAbs2().cwiseInverse(), gradient = D.cwiseProduct(x);
    const double square = gradient.squaredNorm(), length = std::sqrt(square);
    if (!(square > 0) || !std::isfinite(square)) return false;
    out.n = gradient / length;
    out.normal_curvature = -t.cwiseAbs2().dot(D) / length;
    out.gauss = D.prod() * gradient.dot(x) / (square * square);
    return true;
  }

  std::optional<double> gap(const Vec3& x) const {
    SurfacePoint foot;
    if (project(x, foot)) return (x - foot.p).dot(foot.n);
    if (!x.allFinite()) return std::nullopt;
    // Two feet, mirror images in the plane across the shortest axis: their distance is still one number.
    return -distance_from_flat(x);
  }

  // Distance from a point of the flat set between two feet: there t = -c^2, c the shortest radius, the other
  // coordinates of the foot follow from t, and the one along the short axis from the ellipsoid's equation.
  double distance_from_flat(const Vec3& x) const {
    Eigen::Index shortest = 0;
    const double c = a.minCoeff(&shortest);
    Vec3 p = Vec3::Zero();
    double rest = 1;
    for (int i = 0; i < 3; ++i) {
      const double denominator = a[i] * a[i] - c * c;
      if (i == shortest || denominator <= kAmbiguousShare * c * c) continue;
      p[i] = a[i] * a[i] * x[i] / denominator;
      rest -= p[i] * p[i] / (a[i] * a[i]);
    }
    p[shortest] = c * std::sqrt(std::max(rest, 0.0));
    return (p - x).norm();
  }

  Mesh start_mesh(double edge, const Vec3&, double) const {
    // An upper bound of the area is enough to bound the number of triangles.
    const double longest = a.maxCoeff(), area = 4 * kPi * longest * longest;
    return geodesic_mesh(a, affordable_edge(edge, area));
  }
};

}  // namespace

std::unique_ptr<Surface> make_ellipsoid(const Pose& X_BS, const Vec3& radii, bool inside) {
  if (!is_radius(radii.x()) || !is_radius(radii.y()) || !is_radius(radii.z())) return nullptr;
  return std::make_unique<Placed<Ellipsoid>>(X_BS, inside, Ellipsoid{radii});
}

}  // namespace genu
