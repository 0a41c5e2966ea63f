#include "genu/contact/contact_equations.h"

#include <Eigen/LU>

#include "genu/contact/tolerances.h"
#include "genu/core/decompositions.h"

namespace genu {
namespace {

/// Closure and tangency rows over the surface columns. Tangency is scaled by the length, so that every entry is
/// dimensionless and of order 1.
Mat4 scaled_block(const ContactBlock& block, double length) {
  Mat4 local;
  local << block.d_surface.topRows<2>(), length * block.d_surface.bottomRows<2>();
  return local;
}

double one_norm(const Mat4& m) { return m.cwiseAbs().colwise().sum().maxCoeff(); }

/// The same rows over the bodies' twists.
Eigen::Matrix<double, 4, 12> scaled_twist(const ContactBlock& block, double length) {
  Eigen::Matrix<double, 4, 12> twist;
  twist << block.d_twist.topRows<2>(), length * block.d_twist.bottomRows<2>();
  return twist;
}

/// Common quantities of residual and derivatives, in world axes.
struct ContactFrame {
  Vec3 arm_a, arm_b;  ///< from each body's origin to its point
  Vec3 n_a, n_b;
  Mat32 T_a, T_b;
  Vec3 apart;  ///< x_A - x_B

  ContactFrame(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact)
      : arm_a(X_Wa.R * contact.a.p),
        arm_b(X_Wb.R * contact.b.p),
        n_a(X_Wa.R * contact.a.n),
        n_b(X_Wb.R * contact.b.n),
        T_a(X_Wa.R * contact.a.T),
        T_b(X_Wb.R * contact.b.T),
        apart((arm_a + X_Wa.p) - (arm_b + X_Wb.p)) {}

  Vec3 arm_b_to_a() const { return arm_b + apart; }  ///< from the origin of b to the point on A
};

void set_residual_rows(const ContactFrame& f, ContactBlock& out) {
  out.residual << f.T_a.transpose() * f.apart, -f.n_a.dot(f.apart), f.T_a.transpose() * f.n_b;
}

/// The force acts along n_A at x_A: on a [-n, -arm_a x n], on b [n, r x n] with r = x_A - o_b.
void set_direction(const ContactFrame& f, ContactBlock& out) {
  out.direction << -f.n_a, -f.arm_a.cross(f.n_a), f.n_a, f.arm_b_to_a().cross(f.n_a);
}

/// x_A moves with a, x_B with b; n_A and T_A rotate with a, n_B with b: d(t . (x_A - x_B)) = t . v_a + (x_B - o_a) x t
/// . w_a - t . v_b - (arm_b x t) . w_b. The rotation of t acts on x_A - x_B, which vanishes at a solution only.
void set_twist_rows(const ContactFrame& f, WhichMove moves, ContactBlock& out) {
  const Vec3 t[2] = {f.T_a.col(0), f.T_a.col(1)}, tip = f.arm_a - f.apart;
  const Vec3 lever[2] = {t[0].cross(f.n_b), t[1].cross(f.n_b)};
  if (moves.a) {
    auto rows = out.d_twist.leftCols<6>();
    rows.row(0) << t[0].transpose(), tip.cross(t[0]).transpose();
    rows.row(1) << t[1].transpose(), tip.cross(t[1]).transpose();
    rows.row(2) << -f.n_a.transpose(), -tip.cross(f.n_a).transpose();
    rows.row(3) << Vec3::Zero().transpose(), lever[0].transpose();
    rows.row(4) << Vec3::Zero().transpose(), lever[1].transpose();
  }
  if (moves.b) {
    auto rows = out.d_twist.rightCols<6>();
    rows.row(0) << -t[0].transpose(), -f.arm_b.cross(t[0]).transpose();
    rows.row(1) << -t[1].transpose(), -f.arm_b.cross(t[1]).transpose();
    rows.row(2) << f.n_a.transpose(), f.arm_b.cross(f.n_a).transpose();
    rows.row(3) << Vec3::Zero().transpose(), -lever[0].transpose();
    rows.row(4) << Vec3::Zero().transpose(), -lever[1].transpose();
  }
}

/// n_A and T_A change along A (parallel transport: dt = n (S ds)), n_B along B.
void set_surface_columns(const ContactFrame& f, const ContactGeometry& contact, const Mat2& turn, ContactBlock& out) {
  out.d_surface.block<2, 2>(0, 0) = Mat2::Identity() + f.n_a.dot(f.apart) * contact.a.S;
  out.d_surface.block<2, 2>(0, 2) = -turn;
  out.d_surface.block<1, 2>(2, 0) = (f.T_a.transpose() * f.apart).transpose() * contact.a.S;
  out.d_surface.block<1, 2>(2, 2) = f.n_a.transpose() * f.T_b;
  out.d_surface.block<2, 2>(3, 0) = f.n_a.dot(f.n_b) * contact.a.S;
  out.d_surface.block<2, 2>(3, 2) = -turn * contact.b.S;
}

/// Of force * direction, see set_direction().
void set_wrench_derivatives(const ContactFrame& f, const ContactGeometry& contact, double force, WhichMove moves,
                            ContactBlock& out) {
  const Vec3 moment_a = f.arm_a.cross(f.n_a), r = f.arm_b_to_a();
  const Mat3 N = force * skew(f.n_a);             // dn = -[n]x w_a
  const Mat32 dn = -force * f.T_a * contact.a.S;  // by ds_A
  auto twist = [&](int row, int column) { return out.wrench_d_twist.block<3, 3>(row, column); };
  if (moves.a) {
    // arm_a rotates with w_a only, so the whole moment rotates: d = w_a x (arm_a x n)
    out.wrench_d_twist.block<6, 3>(0, 0).setZero();
    twist(0, 3) = N;
    twist(3, 3) = skew(force * moment_a);
  }
  if (moves.b) {
    out.wrench_d_twist.block<6, 6>(6, 6).setZero();
    twist(9, 6) = N;
  }
  if (moves.a && moves.b) {
    // d x_A = v_a - arm_a x w_a
    out.wrench_d_twist.block<6, 6>(0, 6).setZero();
    twist(6, 0).setZero();
    twist(6, 3) = -N;
    twist(9, 0) = -N;
    twist(9, 3) = N * skew(f.arm_a) - skew(r) * N;
  }
  const Mat32 moved = N * f.T_a;
  out.wrench_d_surface.rightCols<2>().setZero();
  out.wrench_d_surface.block<3, 2>(0, 0) = -dn;
  out.wrench_d_surface.block<3, 2>(3, 0) = moved - skew(f.arm_a) * dn;
  out.wrench_d_surface.block<3, 2>(6, 0) = dn;
  out.wrench_d_surface.block<3, 2>(9, 0) = skew(r) * dn - moved;
}

}  // namespace

void evaluate_contact(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact, double force,
                      ContactBlock& out, WhichMove moves) {
  const ContactFrame f(X_Wa, X_Wb, contact);
  set_residual_rows(f, out);
  set_direction(f, out);
  set_twist_rows(f, moves, out);
  set_surface_columns(f, contact, f.T_a.transpose() * f.T_b, out);
  set_wrench_derivatives(f, contact, force, moves, out);
}

void evaluate_contact_residual(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact, ContactBlock& out) {
  const ContactFrame f(X_Wa, X_Wb, contact);
  set_residual_rows(f, out);
  set_direction(f, out);
}

bool EliminatedContact::factor(const ContactBlock& block, double length, WhichMove moves) {
  length_ = length;
  const Mat4 scaled = scaled_block(block, length);
  // By cofactors; one step of Newton's method for the inverse restores the lost digits.
  inverse_ = scaled.inverse();
  const Mat4 missing = Mat4::Identity() - scaled * inverse_;
  inverse_ += (inverse_ * missing).eval();
  rcond = 1 / (one_norm(scaled) * one_norm(inverse_));
  // Where two directions conform at once, all cofactors and the size of their quotients are rounding, and the result is
  // no inverse: for a singular matrix the residual of the inverse is 1 or more.
  if (!(rcond > kSingularContact) || !(one_norm(missing) < kMaxMissingInverse)) {
    rcond = 0;
    return false;
  }
  condense(block, moves);
  return true;
}

void EliminatedContact::factor_minimum_norm(const ContactBlock& block, double length, WhichMove moves) {
  length_ = length;
  const SingularValues svd = singular_values(scaled_block(block, length), LeftVectors::all);
  const Eigen::Index rank = (svd.values.array() > kSingularContact * svd.values[0]).count();
  inverse_.setZero();
  for (Eigen::Index k = 0; k < rank; ++k) inverse_ += svd.V.col(k) / svd.values[k] * svd.U.col(k).transpose();
  condense(block, moves);
  closure = svd.U.rightCols(4 - rank).transpose() * scaled_twist(block, length);
}

void EliminatedContact::condense(const ContactBlock& block, WhichMove moves) {
  closure.resize(0, 12);
  gap_surface_ = block.d_surface.row(2);
  wrench_surface_ = block.wrench_d_surface;
  for (int j = 0; j < 2; ++j) {
    if (!moves[j]) continue;
    Eigen::Matrix<double, 4, 6> twist;
    twist << block.d_twist.block<2, 6>(0, 6 * j), length_ * block.d_twist.block<2, 6>(3, 6 * j);
    const Eigen::Matrix<double, 4, 6> gain = -inverse_.lazyProduct(twist);
    surface_gain.middleCols<6>(6 * j) = gain;
    gap_gradient.segment<6>(6 * j) = (block.d_twist.block<1, 6>(2, 6 * j) + gap_surface_.lazyProduct(gain)).transpose();
    for (int i = 0; i < 2; ++i)
      if (moves[i])
        stiffness.block<6, 6>(6 * i, 6 * j) =
            block.wrench_d_twist.block<6, 6>(6 * i, 6 * j) + wrench_surface_.middleRows<6>(6 * i).lazyProduct(gain);
  }
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
