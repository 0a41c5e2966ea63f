#include "genu/contact/surface_change.h"

namespace genu {

SurfaceChange change_of_field(const SurfacePoint& point, const Vec3& V, const Mat3& dV) {
  return {V.dot(point.n), point.T.transpose() * (dV.transpose() * point.n) - point.S * (point.T.transpose() * V)};
}

ContactChange contact_change(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact, double force,
                             const SurfaceChange& a, const SurfaceChange& b) {
  const Vec3 arm_a = X_Wa.R * contact.a.p, arm_b = X_Wb.R * contact.b.p;
  const Vec3 n_a = X_Wa.R * contact.a.n, n_b = X_Wb.R * contact.b.n;
  const Mat32 T_a = X_Wa.R * contact.a.T, T_b = X_Wb.R * contact.b.T;
  const Vec3 apart = (arm_a + X_Wa.p) - (arm_b + X_Wb.p);
  const Vec3 dn_a = -T_a * a.gradient, dn_b = -T_b * b.gradient;

  ContactChange out;
  out.residual.head<2>() = a.gradient * n_a.dot(apart) - b.w * (T_a.transpose() * n_b);
  out.residual[2] = -dn_a.dot(apart) - a.w + b.w * n_a.dot(n_b);
  out.residual.tail<2>() = a.gradient * n_a.dot(n_b) + T_a.transpose() * dn_b;
  // The force acts along n_A at x_A, which moves along n_A: only the rotation of n_A changes the wrench.
  const Vec3 turned = force * dn_a;
  out.wrench << -turned, -arm_a.cross(turned), turned, (arm_a + X_Wa.p - X_Wb.p).cross(turned);
  return out;
}

}  // namespace genu
