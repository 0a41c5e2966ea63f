#include "genu/model/surface_rates.h"

#include <cmath>

namespace genu {
namespace {

using Kind = Parameter::Kind;

/// A velocity and its derivative by place.
struct VelocityField {
  Vec3 V = Vec3::Zero();
  Mat3 dV = Mat3::Zero();
};

double power(double x, int n) { return n < 0 ? 0 : std::pow(x, n); }

/// Radial velocity `size` away from the axis z, where `size` has the gradient `gradient`.
VelocityField radial_field(const Vec3& x, double size, const Vec3& gradient) {
  const double rho = std::hypot(x.x(), x.y());
  const Vec3 e(x.x() / rho, x.y() / rho, 0), t(-e.y(), e.x(), 0);
  return {size * e, e * gradient.transpose() + size / rho * t * t.transpose()};
}

/// c x^i y^j along z.
VelocityField cartesian_term(const Vec3& x, const SurfaceDef::Term& term) {
  const double xi = power(x.x(), term.i), yj = power(x.y(), term.j);
  VelocityField out;
  out.V.z() = xi * yj;
  out.dV.row(2) << term.i * power(x.x(), term.i - 1) * yj, xi * term.j * power(x.y(), term.j - 1), 0;
  return out;
}

/// c theta^i z^j away from the axis.
VelocityField cylindrical_term(const Vec3& x, const SurfaceDef::Term& term) {
  const double theta = std::atan2(x.y(), x.x()), square = x.x() * x.x() + x.y() * x.y();
  const double ti = power(theta, term.i), zj = power(x.z(), term.j);
  const double by_theta = term.i * power(theta, term.i - 1) * zj;
  const Vec3 gradient(-x.y() / square * by_theta, x.x() / square * by_theta, ti * term.j * power(x.z(), term.j - 1));
  return radial_field(x, ti * zj, gradient);
}

/// Of the points of a shape, in its own frame, per unit of a coefficient.
VelocityField term_field(const SurfaceDef& def, int k, const Vec3& x) {
  const SurfaceDef::Term& term = def.terms[static_cast<std::size_t>(k)];
  return def.shape == SurfaceDef::Shape::polynomial ? cartesian_term(x, term) : cylindrical_term(x, term);
}

/// The same per unit of an ellipsoid's radius.
VelocityField radii_field(const SurfaceDef& def, int k, const Vec3& x) {
  VelocityField out;
  out.V[k] = x[k] / def.radii[k];
  out.dV(k, k) = 1 / def.radii[k];
  return out;
}

/// The change by a field in the surface's own frame.
SurfaceChange in_frame(const SurfaceDef& def, const SurfacePoint& point, const VelocityField& field) {
  const Mat3& R = def.placement.R;
  return change_of_field(point, R * field.V, R * field.dV * R.transpose());
}

}  // namespace

SurfaceChange surface_change(const SurfaceDef& def, const Parameter& parameter, const SurfacePoint& point) {
  if (parameter.kind == Kind::offset) return {1, Vec2::Zero()};
  const int k = parameter.component;
  const Vec3 x = def.placement.R.transpose() * (point.p - def.placement.p);  // in its own frame
  if (parameter.kind == Kind::term) return in_frame(def, point, term_field(def, k, x));
  const double* number = kind_of(def).numbers[static_cast<std::size_t>(parameter.number)].values_of(def);
  if (number == &def.radius || number == &def.minor_radius)
    return {def.inside ? -1.0 : 1.0, Vec2::Zero()};  // the outward side of a socket is the hollow one
  if (number == def.placement.p.data()) return change_of_field(point, Vec3::Unit(k), Mat3::Zero());
  return in_frame(def, point, number == &def.major_radius ? radial_field(x, 1, Vec3::Zero()) : radii_field(def, k, x));
}

}  // namespace genu
