#include "genu/model/bushing.h"

#include <algorithm>
#include <cmath>

#include "genu/model/tolerances.h"

namespace genu {
LogSeries log_series(double angle) {
  const double a2 = angle * angle;
  if (angle < kLogSeriesAngle)
    return {1.0 / 12 + a2 * (1.0 / 720 + a2 * (1.0 / 30240 + a2 * (1.0 / 1209600 + a2 / 47900160))),
            1.0 / 360 + a2 * (1.0 / 7560 + a2 * (1.0 / 201600 + a2 / 5987520))};
  const double half = angle / 2, cot = 1 / std::tan(half), sine = std::sin(half);
  const double c = (1 - half * cot) / a2;
  // d(half cot half) / da = cot / 2 - a / (4 sin^2)
  return {c, (-(cot / 2 - angle / (4 * sine * sine)) / a2 - 2 * c / angle) / angle};
}

Mat3 inverse_left_jacobian(const Vec3& t) {
  const Mat3 k = skew(t);
  return Mat3::Identity() - k / 2 + log_series(t.norm()).c * (k * k);
}

BushingPoint::BushingPoint(const Bushing& bushing, const Pose& X_WA, const Pose& X_WB) {
  const Pose A = X_WA * bushing.frame_a, B = X_WB * bushing.frame_b;
  R_ = A.R;
  turn_ = log_rotation(R_.transpose() * B.R);
  const LogSeries series = log_series(turn_.norm());
  c_ = series.c;
  slope_ = series.slope;
  const Mat3 k = skew(turn_);
  J_ = Mat3::Identity() - k / 2 + c_ * (k * k);
  arm_a_ = B.p - X_WA.p;
  arm_b_ = B.p - X_WB.p;
  q_ << R_.transpose() * (B.p - A.p), turn_;
}

Eigen::Matrix<double, 6, 12> BushingPoint::gradient() const {
  Eigen::Matrix<double, 6, 12> G = Eigen::Matrix<double, 6, 12>::Zero();
  const Mat3 T = R_.transpose();
  G.block<3, 3>(0, 0) = -T;
  G.block<3, 3>(0, 3) = T * skew(arm_a_);
  G.block<3, 3>(0, 6) = T;
  G.block<3, 3>(0, 9) = -T * skew(arm_b_);
  G.block<3, 3>(3, 3) = -J_ * T;
  G.block<3, 3>(3, 9) = J_ * T;
  return G;
}

Vec12 BushingPoint::wrench(const Vec6& f) const {
  const Vec3 force = R_ * f.head<3>(), moment = R_ * (J_.transpose() * f.tail<3>());
  Vec12 out;
  out << -force, -arm_a_.cross(force) - moment, force, arm_b_.cross(force) + moment;
  return out;
}

Eigen::Matrix<double, 12, 12> BushingPoint::wrench_rate(const Vec6& f) const {
  const Vec3 force = R_ * f.head<3>(), g = f.tail<3>(), moment = R_ * (J_.transpose() * g);
  const Mat3 F = skew(force), T = R_.transpose(), k = skew(turn_);
  // d(J^-T g) for a change of the rotation vector; J^-T = 1 + [t]x / 2 + c [t]x^2
  const Vec3 once = turn_.cross(g);
  const Mat3 turned = -skew(g) / 2 - c_ * (skew(once) + k * skew(g)) + slope_ * turn_.cross(once) * turn_.transpose();
  const Mat3 by_b = R_ * turned * J_ * T;  // of the moment, by the twist of B; of A: -by_b, and it turns with A
  Eigen::Matrix<double, 12, 12> out = Eigen::Matrix<double, 12, 12>::Zero();
  // The force turns with A: dF = w_A x F.
  out.block<3, 3>(0, 3) = F;
  out.block<3, 3>(6, 3) = -F;
  // Moment on B: arm_b x F + M, arm_b turns with B.
  out.block<3, 3>(9, 3) = -skew(arm_b_) * F - skew(moment) - by_b;
  out.block<3, 3>(9, 9) = F * skew(arm_b_) + by_b;
  // Moment on A: -arm_a x F - M, the arm changes by v_B + w_B x arm_b - v_A.
  out.block<3, 3>(3, 0) = -F;
  out.block<3, 3>(3, 3) = skew(arm_a_) * F + skew(moment) + by_b;
  out.block<3, 3>(3, 6) = F;
  out.block<3, 3>(3, 9) = -F * skew(arm_b_) - by_b;
  return out;
}

Vec6 BushingPoint::on_frame(const Vec6& f) const {
  Vec6 out;
  out << f.head<3>(), J_.transpose() * f.tail<3>();
  return out;
}

Bushing make_bushing(const BushingDef& def) {
  Bushing b{def.name, def.from.body, def.to.body, def.from.placement, def.to.placement};
  Vec6 stiffness, damping;
  stiffness << def.stiffness, def.rotation_stiffness;
  damping << def.damping, def.rotation_damping;
  b.stiffness = def.matrix ? *def.matrix : Mat6(stiffness.asDiagonal());
  b.damping = damping.asDiagonal();
  return b;
}

double Bushing::largest_force(double length) const {
  return std::max(length * stiffness.diagonal().head<3>().maxCoeff(),
                  stiffness.diagonal().tail<3>().maxCoeff() / length);
}

double energy_of(const Bushing& bushing, const Pose& X_WA, const Pose& X_WB) {
  const Vec6 q = BushingPoint(bushing, X_WA, X_WB).displacement();
  return q.dot(bushing.stiffness * q) / 2;
}

}  // namespace genu
