#include "genu/core/pose.h"

#include <cmath>

#include <Eigen/Geometry>

#include "genu/core/tolerances.h"

namespace genu {

Mat3 exp_rotation(const Vec3& w) {
  const double angle2 = w.squaredNorm();
  const double angle = std::sqrt(angle2);
  // Below this angle the next term of either series is under rounding: angle^4 / 120 < 1e-18.
  double a = 0, b = 0;  // sin(angle)/angle and (1 - cos(angle))/angle^2
  if (angle < kSeriesAngle) {
    a = 1 - angle2 / 6;
    b = 0.5 - angle2 / 24;
  } else {
    const double half = std::sin(angle / 2);
    a = std::sin(angle) / angle;
    b = 2 * half * half / angle2;
  }
  const Mat3 k = skew(w);
  return Mat3::Identity() + a * k + b * (k * k);
}

Vec3 log_rotation(const Mat3& R) {
  Eigen::Quaterniond q(R);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double s = q.vec().norm();
  const double factor = s < kSeriesSine ? 2 / q.w() : 2 * std::atan2(s, q.w()) / s;
  return factor * q.vec();
}

Pose retract(const Pose& pose, const Vec6& twist) {
  Pose out;
  out.p = pose.p + twist.head<3>();
  Eigen::Quaterniond q(Mat3(exp_rotation(twist.tail<3>()) * pose.R));
  out.R = q.normalized().toRotationMatrix();
  return out;
}

}  // namespace genu
