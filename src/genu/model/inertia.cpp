#include "genu/model/inertia.h"

namespace genu {
namespace {

Mat3 in_world(const Inertia& inertia, const Mat3& R) { return R * inertia.about_centre_of_mass * R.transpose(); }

}  // namespace

Mat6 mass_matrix(const Inertia& inertia, const Mat3& R) {
  const Mat3 c = skew(R * inertia.centre_of_mass);
  Mat6 M;
  M.topLeftCorner<3, 3>() = inertia.mass * Mat3::Identity();
  M.topRightCorner<3, 3>() = -inertia.mass * c;
  M.bottomLeftCorner<3, 3>() = inertia.mass * c;
  M.bottomRightCorner<3, 3>() = in_world(inertia, R) - inertia.mass * (c * c);
  return M;
}

Vec6 gyroscopic_wrench(const Inertia& inertia, const Mat3& R, const Vec3& w) {
  const Vec3 c = R * inertia.centre_of_mass;
  const Vec3 centripetal = inertia.mass * w.cross(w.cross(c));
  Vec6 b;
  b << centripetal, w.cross(in_world(inertia, R) * w) + c.cross(centripetal);
  return b;
}

double kinetic_energy(const Inertia& inertia, const Mat3& R, const Vec6& twist) {
  return 0.5 * twist.dot(mass_matrix(inertia, R) * twist);
}

}  // namespace genu
