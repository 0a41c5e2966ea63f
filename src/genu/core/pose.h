// Rigid poses and their increments.
//
// X_WF is the pose of frame F in frame W; p_W = X_WF * p_F. A twist [v, w] (m, rad, both in the axes of W)
// moves the origin of F by v and turns F by w about that origin: p <- p + v, R <- exp(w) R.
#pragma once

#include "genu/core/types.h"

namespace genu {

struct Pose {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();

  Vec3 operator*(const Vec3& x) const { return R * x + p; }
  Pose operator*(const Pose& other) const { return {R * other.R, R * other.p + p}; }
  bool operator==(const Pose& other) const { return R == other.R && p == other.p; }
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// Rotation by the vector w (rad): Rodrigues' formula, exact to rounding for every angle, small ones included.
Mat3 exp_rotation(const Vec3& w);

/// The rotation vector of R (rad, norm at most pi), the inverse of exp_rotation, accurate near 0 and near pi.
Vec3 log_rotation(const Mat3& R);

/// The pose after the twist [v, w]; the rotation is re-orthonormalised, so that long paths do not drift.
Pose retract(const Pose& pose, const Vec6& twist);

}  // namespace genu
