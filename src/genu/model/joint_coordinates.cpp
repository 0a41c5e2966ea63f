#include "genu/model/joint_coordinates.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "genu/model/tolerances.h"

namespace genu {

namespace {

/// The angle's multiple of 2 pi nearest to `near`.
double unwind(double angle, double near) {
  constexpr double kTurn = 2 * std::numbers::pi;
  return angle + kTurn * std::round((near - angle) / kTurn);
}

}  // namespace

JointCoordinates::JointCoordinates(const JointDef& joint, Vec3 parent_centre, Vec3 child_centre)
    : a_{joint.rotations[0].axis, joint.rotations[1].axis, joint.rotations[2].axis},
      a12_(a_[0].cross(a_[1])),
      parent_centre_(std::move(parent_centre)),
      child_centre_(std::move(child_centre)),
      offset_(std::atan2(a_[2].dot(a_[0]), a_[2].dot(a12_))) {}

bool JointCoordinates::is_valid(const std::array<JointDef::Rotation, 3>& rotations) {
  const Vec3 &a1 = rotations[0].axis, &a2 = rotations[1].axis, &a3 = rotations[2].axis;
  for (const auto& rotation : rotations)
    if (!(std::abs(rotation.axis.norm() - 1) < kUnitAxisTolerance)) return false;
  return std::abs(a1.dot(a2)) < kUnitAxisTolerance && std::abs(a2.dot(a3)) < kUnitAxisTolerance;
}

Pose JointCoordinates::pose_from(const JointValues& q) const {
  const Mat3 R = exp_rotation(q[0] * a_[0]) * exp_rotation(q[1] * a_[1]) * exp_rotation(q[2] * a_[2]);
  return {R, Vec3(q[3], q[4], q[5]) + R * child_centre_ - parent_centre_};
}

/// In the basis a1, a2, a1 x a2, with beta the second angle + offset_:
///   R a3 = R1 R2 a3 = (sin beta, -sin q0 cos beta, cos q0 cos beta),
/// so that beta and pi - beta (branch +1, -1: the sign of cos beta) are both solutions, and cos beta = 0 is the gimbal
/// pose.
Vec3 JointCoordinates::angles(const Mat3& R, const Vec3& near, double branch) const {
  const Vec3 g = R * a_[2];
  const double g1 = g.dot(a_[0]), g2 = branch * g.dot(a_[1]), g3 = branch * g.dot(a12_);
  const double cos_beta = std::sqrt(g2 * g2 + g3 * g3);
  const bool undecided = cos_beta < kGimbalCosine;

  Vec3 q;
  q[0] = undecided ? near[0] : unwind(std::atan2(-g2, g3), near[0]);
  q[1] = unwind(std::atan2(g1, branch * cos_beta) - offset_, near[1]);
  // R3 a2 = R2^T R1^T (R a2): its components along a2 and a3 x a2 give the remaining angle.
  const double s0 = undecided ? std::sin(q[0]) : -g2 / cos_beta, c0 = undecided ? std::cos(q[0]) : g3 / cos_beta;
  const Vec3 v = R * a_[1];
  const double v1 = v.dot(a_[0]), v2 = v.dot(a_[1]), v3 = v.dot(a12_);
  q[2] = unwind(std::atan2(g1 * (c0 * v3 - s0 * v2) - branch * cos_beta * v1, c0 * v2 + s0 * v3), near[2]);
  if (undecided) {  // only q0 + sign q2 is known: divide the difference equally
    const double half = (q[2] - near[2]) / 2;
    q[2] -= half;
    q[0] += g1 > 0 ? half : -half;
  }
  return q;
}

JointValues JointCoordinates::coordinates(const Pose& X_PC, const JointValues& near) const {
  const Vec3 wanted(near[0], near[1], near[2]);
  Vec3 q = angles(X_PC.R, wanted, 1);
  // The first angles of the two solutions differ by half a turn: one within a quarter turn is the nearer one.
  constexpr double kQuarter = std::numbers::pi / 2;
  if (const double apart = (q - wanted).squaredNorm(); !(apart < kQuarter * kQuarter))
    if (const Vec3 other = angles(X_PC.R, wanted, -1); (other - wanted).squaredNorm() < apart) q = other;
  const Vec3 t = (X_PC.p + parent_centre_) - X_PC.R * child_centre_;
  return {q[0], q[1], q[2], t[0], t[1], t[2]};
}

JointPoint JointCoordinates::evaluate(const Pose& X_WP, const Pose& X_WC, const JointValues& near) const {
  const Pose X_PC{X_WP.R.transpose() * X_WC.R, X_WP.R.transpose() * (X_WC.p - X_WP.p)};
  return derivatives(X_WP, X_WC, coordinates(X_PC, near));
}

JointPoint JointCoordinates::derivatives(const Pose& X_WP, const Pose& X_WC, const JointValues& values) const {
  JointPoint out;
  out.parent_ = X_WP.R;
  out.values_ = values;
  out.arm_ = -(X_WC.R * child_centre_);
  out.offset_ = X_WC.p - X_WP.p + out.arm_;
  const Vec3 floating = std::cos(out.values_[0]) * a_[1] + std::sin(out.values_[0]) * a12_;
  const Vec3 b1 = X_WP.R * a_[0], b2 = X_WP.R * floating, b3 = X_WC.R * a_[2];
  out.axes_ << b1, b2, b3;
  const double det = b1.dot(b2.cross(b3));
  out.gimbal_sine_ = std::abs(det);
  if (out.at_gimbal())
    out.rows_ << b1 / 2, b2, b3 / 2;
  else
    out.rows_ << b2.cross(b3) / det, b2, b1.cross(b2) / det;
  return out;
}

JointPoint::Gradient JointPoint::gradient(int i) const {
  if (i >= 3) return translation_gradient(i - 3);
  Gradient out = Gradient::Zero();
  out.segment<3>(3) = -rows_.col(i).transpose();
  out.segment<3>(9) = rows_.col(i).transpose();
  return out;
}

JointPoint::Hessian JointPoint::hessian(int i) const {
  if (i >= 3) return translation_hessian(i - 3);
  return at_gimbal() ? Hessian::Zero() : rotation_hessian(i);
}

/// dg_i = -sum_k (g_i . db_k) g_k with db_k = w_k x b_k, where the axes turn with w_1 = w_P, w_3 = w_C, and the
/// floating one with w_2 = w_P + b1 q0', q0' = g_1 . (w_C - w_P).
JointPoint::Hessian JointPoint::rotation_hessian(int i) const {
  const Vec3 g = rows_.col(i), g1 = rows_.col(0), b1 = axes_.col(0), b2 = axes_.col(1), b3 = axes_.col(2);
  const Vec3 floating = b2.cross(g);
  const Mat3 by_q0 = rows_.col(1) * (floating.dot(b1) * g1).transpose();
  const Mat3 to_P = -(g1 * b1.cross(g).transpose() + rows_.col(1) * floating.transpose() - by_q0);
  const Mat3 to_C = -(rows_.col(2) * b3.cross(g).transpose() + by_q0);
  Hessian out = Hessian::Zero();
  out.block<3, 3>(3, 3) = -to_P;
  out.block<3, 3>(3, 9) = -to_C;
  out.block<3, 3>(9, 3) = to_P;
  out.block<3, 3>(9, 9) = to_C;
  return out;
}

/// q = b . d with b an axis of the parent, d the offset and r the child's arm in it:
///   dq = b . (v_C + w_C x r - v_P) + w_P . (b x d).
JointPoint::Gradient JointPoint::translation_gradient(int i) const {
  const Vec3 b = parent_.col(i);
  Gradient out;
  out << -b.transpose(), b.cross(offset_).transpose(), b.transpose(), arm_.cross(b).transpose();
  return out;
}

/// db = w_P x b, d(b x d) = (w_P x b) x d + b x (v_C + w_C x r - v_P), d(r x b) = (w_C x r) x b + r x (w_P x b).
JointPoint::Hessian JointPoint::translation_hessian(int i) const {
  const Mat3 b = skew(parent_.col(i));
  Hessian out = Hessian::Zero();
  out.block<3, 3>(0, 3) = b;
  out.block<3, 3>(6, 3) = -b;
  out.block<3, 3>(3, 0) = -b;
  out.block<3, 3>(3, 3) = skew(offset_) * b;
  out.block<3, 3>(3, 6) = b;
  const Mat3 r = skew(arm_);
  out.block<3, 3>(3, 9) = -b * r;
  out.block<3, 3>(9, 3) = -r * b;
  out.block<3, 3>(9, 9) = b * r;
  return out;
}

}  // namespace genu
