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

/// Velocity of the points of a shape, in its own frame, per unit of one of its parameters.
VelocityField shape_field(const SurfaceDef& def, const Parameter& parameter, const Vec3& x) {
  VelocityField out;
  const int k = parameter.component;
  switch (parameter.kind) {
    case Kind::radii:
      out.V[k] = x[k] / def.radii[k];
      out.dV(k, k) = 1 / def.radii[k];
      break;
    case Kind::major_radius:
      return radial_field(x, 1, Vec3::Zero());
    case Kind::term: {
      const SurfaceDef::Term& term = def.terms[static_cast<std::size_t>(k)];
      return def.shape == SurfaceDef::Shape::polynomial ? cartesian_term(x, term) : cylindrical_term(x, term);
    }
    default:
      break;
  }
  return out;
}

}  // namespace

SurfaceChange surface_change(const SurfaceDef& def, const Parameter& parameter, const SurfacePoint& point) {
  switch (parameter.kind) {
    case Kind::offset:
      return {1, Vec2::Zero()};
    case Kind::radius:
    case Kind::minor_radius:  // the outward side of a socket is the concave one
      return {def.inside ? -1.0 : 1.0, Vec2::Zero()};
    case Kind::origin:
      return change_of_field(point, Vec3::Unit(parameter.component), Mat3::Zero());
    default: {
      const Mat3& R = def.placement.R;
      const VelocityField field = shape_field(def, parameter, R.transpose() * (point.p - def.placement.p));
      return change_of_field(point, R * field.V, R * field.dV * R.transpose());
    }
  }
}

}  // namespace genu
