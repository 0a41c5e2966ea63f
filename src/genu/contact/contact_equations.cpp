#include "genu/contact/contact_equations.h"

#include <Eigen/LU>

#include "genu/core/decompositions.h"

namespace genu {
namespace {

/// d(a . x)/d twist for a fixed direction a and a point x carried by a body with origin o: [a, (x - o) x a].
Eigen::Matrix<double, 1, 6> point_row(const Vec3& a, const Vec3& arm) {
  Eigen::Matrix<double, 1, 6> row;
  row << a.transpose(), arm.cross(a).transpose();
  return row;
}

/// Closure and tangency rows over the surface columns; tangency scaled by the length, so that every entry is a pure
/// number of order 1.
Mat4 scaled_block(const ContactBlock& block, double length) {
  Mat4 local;
  local << block.d_surface.topRows<2>(), length * block.d_surface.bottomRows<2>();
  return local;
}

/// The same rows over the bodies' twists.
Eigen::Matrix<double, 4, 12> scaled_twist(const ContactBlock& block, double length) {
  Eigen::Matrix<double, 4, 12> twist;
  twist << block.d_twist.topRows<2>(), length * block.d_twist.bottomRows<2>();
  return twist;
}

}  // namespace

void evaluate_contact(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact, double force,
                      ContactBlock& out) {
  const Vec3 arm_a = X_Wa.R * contact.a.p, arm_b = X_Wb.R * contact.b.p;
  const Vec3 n_a = X_Wa.R * contact.a.n, n_b = X_Wb.R * contact.b.n;
  const Mat32 T_a = X_Wa.R * contact.a.T, T_b = X_Wb.R * contact.b.T;
  const Vec3 apart = (arm_a + X_Wa.p) - (arm_b + X_Wb.p);  // x_A - x_B
  const Mat2 turn = T_a.transpose() * T_b;
  const double opposed = n_a.dot(n_b);  // -1 at a solution

  out.residual << T_a.transpose() * apart, -n_a.dot(apart), T_a.transpose() * n_b;

  // x_A moves with a, x_B with b; n_A and T_A turn with a and along A (parallel transport: dt = n (S ds)),
  // n_B turns with b and along B. The rotation of T_A and n_A acts on `apart`, which vanishes at a solution only.
  for (int i = 0; i < 2; ++i) {
    const Vec3 t = T_a.col(i);
    out.d_twist.block<1, 6>(i, 0) = point_row(t, arm_a);
    out.d_twist.block<1, 3>(i, 3) += t.cross(apart).transpose();
    out.d_twist.block<1, 6>(i, 6) = -point_row(t, arm_b);
    const Vec3 lever = t.cross(n_b);
    out.d_twist.block<1, 12>(3 + i, 0).setZero();
    out.d_twist.block<1, 3>(3 + i, 3) = lever.transpose();
    out.d_twist.block<1, 3>(3 + i, 9) = -lever.transpose();
  }
  out.d_twist.block<1, 6>(2, 0) = -point_row(n_a, arm_a);
  out.d_twist.block<1, 3>(2, 3) -= n_a.cross(apart).transpose();
  out.d_twist.block<1, 6>(2, 6) = point_row(n_a, arm_b);

  const double normal_apart = n_a.dot(apart);
  const Vec2 tangential_apart = T_a.transpose() * apart;
  out.d_surface.block<2, 2>(0, 0) = Mat2::Identity() + normal_apart * contact.a.S;
  out.d_surface.block<2, 2>(0, 2) = -turn;
  out.d_surface.block<1, 2>(2, 0) = tangential_apart.transpose() * contact.a.S;
  out.d_surface.block<1, 2>(2, 2) = n_a.transpose() * T_b;
  out.d_surface.block<2, 2>(3, 0) = opposed * contact.a.S;
  out.d_surface.block<2, 2>(3, 2) = -turn * contact.b.S;

  // The force acts along n_A at x_A: +n_A on b, -n_A on a.
  const Vec3 arm_b_of_a = arm_a + X_Wa.p - X_Wb.p;  // x_A seen from b's origin
  out.direction << -n_a, -arm_a.cross(n_a), n_a, arm_b_of_a.cross(n_a);

  const Mat3 dn_da = -skew(n_a);           // d n_A / d w_a
  const Mat32 dn_ds = -T_a * contact.a.S;  // d n_A / d s_A
  Eigen::Matrix<double, 3, 6> dx_da;       // d x_A / d twist_a
  dx_da << Mat3::Identity(), -skew(arm_a);
  const Mat3 N = skew(n_a);
  out.wrench_d_twist.setZero();
  out.wrench_d_surface.setZero();
  auto twist = [&](int row, int column) { return out.wrench_d_twist.block<3, 3>(row, column); };
  // on a: [-n, -arm_a x n]; arm_a turns with w_a alone, so the whole moment turns: d = w_a x (arm_a x n)
  twist(0, 3) = -dn_da;
  twist(3, 3) = skew(arm_a.cross(n_a));
  // on b: [n, (x_A - o_b) x n]
  twist(6, 3) = dn_da;
  out.wrench_d_twist.block<3, 6>(9, 0) = -N * dx_da;
  twist(9, 3) += skew(arm_b_of_a) * dn_da;
  twist(9, 6) = N;
  out.wrench_d_surface.block<3, 2>(0, 0) = -dn_ds;
  out.wrench_d_surface.block<3, 2>(3, 0) = N * T_a - skew(arm_a) * dn_ds;
  out.wrench_d_surface.block<3, 2>(6, 0) = dn_ds;
  out.wrench_d_surface.block<3, 2>(9, 0) = -N * T_a + skew(arm_b_of_a) * dn_ds;
  out.wrench_d_twist *= force;
  out.wrench_d_surface *= force;
}

bool EliminatedContact::factor(const ContactBlock& block, double length) {
  length_ = length;
  const Eigen::PartialPivLU<Mat4> lu(scaled_block(block, length));
  // A pivot that is exactly zero makes rcond() meaningless, so look at the pivots first.
  rcond = lu.matrixLU().diagonal().cwiseAbs().minCoeff() > 0 ? lu.rcond() : 0;
  if (!(rcond > kSingular)) return false;
  inverse_ = lu.inverse();
  condense(block);
  return true;
}

void EliminatedContact::factor_minimum_norm(const ContactBlock& block, double length) {
  length_ = length;
  const SingularValues svd = singular_values(scaled_block(block, length), LeftVectors::all);
  const Eigen::Index rank = (svd.values.array() > kSingular * svd.values[0]).count();
  inverse_.setZero();
  for (Eigen::Index k = 0; k < rank; ++k) inverse_ += svd.V.col(k) / svd.values[k] * svd.U.col(k).transpose();
  condense(block);
  closure = svd.U.rightCols(4 - rank).transpose() * scaled_twist(block, length);
}

void EliminatedContact::condense(const ContactBlock& block) {
  const Eigen::Matrix<double, 4, 12> twist = scaled_twist(block, length_);
  closure.resize(0, 12);
  gap_surface_ = block.d_surface.row(2);
  wrench_surface_ = block.wrench_d_surface;
  surface_gain.noalias() = -inverse_ * twist;
  gap_gradient = (block.d_twist.row(2) + gap_surface_ * surface_gain).transpose();
  stiffness = block.wrench_d_twist;
  stiffness.noalias() += wrench_surface_ * surface_gain;
  set_residual(block.residual);
}

void EliminatedContact::set_residual(const Vec5& residual) {
  const Vec4 scaled(residual[0], residual[1], length_ * residual[3], length_ * residual[4]);
  surface_offset.noalias() = -inverse_ * scaled;
  gap = residual[2] + gap_surface_.dot(surface_offset);
  wrench_offset = wrench_surface_ * surface_offset;
}

Mat2 relative_curvature(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact) {
  const Mat2 turn = (X_Wa.R * contact.a.T).transpose() * (X_Wb.R * contact.b.T);
  return -(contact.a.S + turn * contact.b.S * turn.transpose());
}

}  // namespace genu
