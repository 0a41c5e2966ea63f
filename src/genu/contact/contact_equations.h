// The five equations of one rigid, frictionless contact point and what they add to equilibrium (Dortmans 1984, the
// contact conditions and the contact force), with every derivative.
//
// Between a point of surface A (body a) and a point of surface B (body b), all in world axes:
//     closure   T_A^T (x_A - x_B) = 0   (2)      the points coincide, tangentially
//     gap       n_A . (x_B - x_A) = 0   (1)      ... and normally: the gap, positive when open
//     tangency  T_A^T n_B = 0           (2)      the normals are parallel
// The unknowns are the twists of both bodies, the lengths ds_A, ds_B in the tangent planes, and the normal force.
#pragma once

#include "genu/core/pose.h"
#include "genu/core/which_move.h"
#include "genu/surface/surface.h"

namespace genu {

using Vec5 = Eigen::Matrix<double, 5, 1>;

/// Two facing surface points, each in the frame of its own body.
struct ContactGeometry {
  SurfacePoint a, b;
};

/// Residual and derivatives of one contact. Twist columns: [v_a, w_a, v_b, w_b] in world axes, each about its body's
/// origin; surface columns: [ds_A, ds_B]. Rows of `residual`: closure 0-1, gap 2, tangency 3-4.
struct ContactBlock {
  Vec5 residual = Vec5::Zero();  ///< m, m, m, 1, 1
  Eigen::Matrix<double, 5, 12> d_twist = Eigen::Matrix<double, 5, 12>::Zero();
  Eigen::Matrix<double, 5, 4> d_surface = Eigen::Matrix<double, 5, 4>::Zero();
  Vec12 direction = Vec12::Zero();       ///< wrench on [a; b] of a unit normal force, about each body's origin
  Mat12 wrench_d_twist = Mat12::Zero();  ///< of force * direction
  Eigen::Matrix<double, 12, 4> wrench_d_surface = Eigen::Matrix<double, 12, 4>::Zero();
};

/// Evaluates the block for the normal force `force` (N, positive pushes the bodies apart). Derivatives of a body that
/// does not move, and of the wrench on it, do not change.
void evaluate_contact(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact, double force,
                      ContactBlock& out, WhichMove moves = {});

/// `residual` and `direction` only; the derivatives do not change.
void evaluate_contact_residual(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact, ContactBlock& out);

/// The same contact with its four surface coordinates eliminated by the closure and tangency rows:
/// ds = surface_offset + surface_gain * twist.
class EliminatedContact {
 public:
  /// Factors the contact's own 4x4 block; `length` (m) scales curvature in it. Returns false where it is singular to
  /// working accuracy (vanishing relative curvature: parallel planes, line contact, a contact about to split): the
  /// dense route serves then. Gradient, gain and stiffness over a body that does not move are left as
  /// they were.
  bool factor(const ContactBlock& block, double length, WhichMove moves = {});

  /// The same where the block is singular (the surfaces conform along a line or an area): a minimum-norm solution.
  /// `closure` receives the rows that no motion along the surfaces can satisfy. For stability only, where the
  /// undetermined motion changes no force to first order.
  void factor_minimum_norm(const ContactBlock& block, double length, WhichMove moves = {});

  /// Sets gap, surface_offset and wrench_offset for the given residual, which may belong to another state.
  void set_residual(const Vec5& residual);

  double rcond = 0;                     ///< reciprocal condition of the 4x4 block; 0 is singular
  double gap = 0;                       ///< residual of the gap row after elimination, m
  Vec12 gap_gradient = Vec12::Zero();   ///< d gap / d twist
  Vec12 wrench_offset = Vec12::Zero();  ///< change of the wrench by the surface offset
  Mat12 stiffness = Mat12::Zero();      ///< d wrench / d twist
  Vec4 surface_offset = Vec4::Zero();   ///< m
  Eigen::Matrix<double, 4, 12> surface_gain = Eigen::Matrix<double, 4, 12>::Zero();
  /// At most 4 x 12, rows to be held at 0: motions that would separate conforming surfaces except at a point are
  /// excluded.
  Eigen::Matrix<double, Eigen::Dynamic, 12, 0, 4, 12> closure;

 private:
  void condense(const ContactBlock& block, WhichMove moves);

  Mat4 inverse_;  ///< of the scaled 4x4 block
  double length_ = 1;
  Eigen::Matrix<double, 1, 4> gap_surface_;
  Eigen::Matrix<double, 12, 4> wrench_surface_;
};

/// Relative curvature of the two surfaces at a contact (1/m), in A's tangent basis: the Hessian of the gap over the
/// common tangent plane. Positive definite where the gap has a strict local minimum.
Mat2 relative_curvature(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact);

}  // namespace genu
