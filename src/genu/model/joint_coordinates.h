// The six coordinates of a child body in its parent: three successive rotations and the child's origin.
//
// R_PC = R1(q0) R2(q1) R3(q2) about the signed axes a1, a2, a3 of the joint, and q3..q5 = p_PC in the parent's axes.
// In the world the joint turns about b1 = R_WP a1 (fixed in the parent), b2 = R_WP R1 a2 (floating) and b3 = R_WC a3
// (fixed in the child):   w_C - w_P = b1 q0' + b2 q1' + b3 q2' = J q'. The rows g of J^-1 are the gradients of the
// angles; their derivative is that of an inverse, dJ^-1 = -J^-1 dJ J^-1. With b2 perpendicular to b1 and b3, det J = b1
// . (b2 x b3) has only one zero: the gimbal pose, where b1 and b3 are parallel.
#pragma once

#include <array>

#include "genu/core/pose.h"
#include "genu/core/types.h"
#include "genu/model/tolerances.h"
#include "genu/scene/scene.h"

namespace genu {

/// Rotations (rad), then translations (m).
using JointValues = std::array<double, 6>;

/// Values and derivatives of a joint's coordinates at one pose of parent P and child C in the world.
class JointPoint {
 public:
  using Gradient = Eigen::Matrix<double, 1, 12>;
  using Hessian = Eigen::Matrix<double, 12, 12>;

  /// |sine| of the angle between the first and the last axis: 0 at the gimbal pose, 1 farthest from it. The gradients
  /// of the first and last angle grow like its inverse, their derivatives like its inverse square.
  double gimbal_sine() const { return gimbal_sine_; }

  /// At the gimbal pose the first and last angle are not defined separately. The gradients are then rows of the
  /// pseudo-inverse (each takes half of the common rotation), and the second derivatives of the angles are set to 0.
  bool at_gimbal() const { return gimbal_sine_ < kGimbalSine; }

  const JointValues& values() const { return values_; }

  /// d q_i / d [twist of P; twist of C], i in 0..5. Also the wrench on P and C of a unit generalised force on q_i:
  /// [force, moment about the body's origin] each, world axes.
  Gradient gradient(int i) const;

  /// d gradient(i)^T / d [twist of P; twist of C]. Not symmetric: rotations do not commute.
  Hessian hessian(int i) const;

 private:
  friend class JointCoordinates;

  Gradient translation_gradient(int i) const;
  Hessian translation_hessian(int i) const;
  Hessian rotation_hessian(int i) const;

  JointValues values_{};
  Vec3 arm_ = Vec3::Zero();     ///< from the reference point of the child's twist to the origin of its translations, m
  Mat3 axes_ = Mat3::Zero();    ///< columns b1, b2, b3
  Mat3 rows_ = Mat3::Zero();    ///< columns: gradients of the angles to w_C - w_P
  Mat3 parent_ = Mat3::Zero();  ///< R_WP
  /// From the reference point of the parent's twist to the child's origin of translations, world axes, m.
  Vec3 offset_ = Vec3::Zero();
  double gimbal_sine_ = 1;
};

class JointCoordinates {
 public:
  /// Poses and twists refer to frames with origins at `parent_centre` and `child_centre` (m) in the bodies.
  /// Translations are those of the child's own origin from the parent's own (see centre_bodies.h).
  explicit JointCoordinates(const JointDef& joint, Vec3 parent_centre = Vec3::Zero(), Vec3 child_centre = Vec3::Zero());

  /// Whether three axes define coordinates: unit vectors, each perpendicular to the one before. The first and last may
  /// be perpendicular (Cardan), parallel (proper Euler) or anything between. All functions below require this.
  static bool is_valid(const std::array<JointDef::Rotation, 3>& rotations);

  /// X_PC = { R1 R23, t + R child_centre - parent_centre }, in parts: R1(q0), and R23 = R2(q1) R3(q2).
  Mat3 rotation_about_first(double angle) const { return exp_rotation(angle * a_[0]); }
  Mat3 rotation_after_first(const JointValues& values) const {
    return exp_rotation(values[1] * a_[1]) * exp_rotation(values[2] * a_[2]);
  }
  const Vec3& first_axis() const { return a_[0]; }  ///< unit, in the parent
  const Vec3& parent_centre() const { return parent_centre_; }
  const Vec3& child_centre() const { return child_centre_; }

  /// X_PC for the coordinates.
  Pose pose_from(const JointValues& values) const;

  /// The coordinates of X_PC. Two triples of angles (and their multiples of 2 pi) give the same rotation; returns the
  /// one nearest to the angles of `near` (least squares). At the gimbal pose it is the nearest of all solutions.
  JointValues coordinates(const Pose& X_PC, const JointValues& near) const;

  /// Values (chosen by `near` as in coordinates()) and derivatives, for poses in the world.
  JointPoint evaluate(const Pose& X_WP, const Pose& X_WC, const JointValues& near) const;

  /// The same for known `values` of these poses.
  JointPoint derivatives(const Pose& X_WP, const Pose& X_WC, const JointValues& values) const;

 private:
  Vec3 angles(const Mat3& R, const Vec3& near, double branch) const;

  std::array<Vec3, 3> a_;  ///< a1, a2 in the parent's axes at angles 0, a3 in the child's
  Vec3 a12_;               ///< a1 x a2
  Vec3 parent_centre_, child_centre_;
  double offset_;  ///< angle of a3 from a1 x a2 toward a1, about a2
};

}  // namespace genu
