#include "genu/model/ligament.h"

#include <Eigen/Geometry>

namespace genu {

namespace {

/// Lever arms and the pull t on A, kept for the stiffness.
struct PullLine {
  Vec3 r_A, r_B;  ///< from the bodies' origins to the ends, world axes, m
  Vec3 d;         ///< from the end on A to the end on B, m
  Vec3 t;         ///< pull on A, N
  double stiffness = 0;
};

void set_wrenches(const PullLine& line, TwoBodyWrench& out) {
  out.on_a << line.t, line.r_A.cross(line.t);
  out.on_b << -line.t, -line.r_B.cross(line.t);
}

bool pull(const Ligament& ligament, const Pose& X_WA, const Pose& X_WB, int piece, PullLine& line, TwoBodyWrench& out) {
  line.r_A = X_WA.R * ligament.p_A;
  line.r_B = X_WB.R * ligament.p_B;
  line.d = (X_WB.p - X_WA.p) + (line.r_B - line.r_A);
  out.length = line.d.norm();
  out.strain = ligament.law.strain(out.length);
  const bool by_length = piece == LigamentLaw::kByLength;
  const bool slack = by_length ? out.length <= ligament.law.slack_until() : ligament.law.is_slack(piece);
  if (slack) {
    out.on_a.setZero();
    out.on_b.setZero();
    out.force = out.energy = 0;
    return false;
  }
  const LawValue law = ligament.law.evaluate(out.length, piece);
  out.force = law.force;
  out.energy = law.energy;
  line.stiffness = law.stiffness;
  line.t = out.length > 0 ? Vec3(law.force / out.length * line.d) : Vec3::Zero();
  set_wrenches(line, out);
  return true;
}

/// dt/dd: along the line the law's stiffness, across it the tension's.
Mat3 line_stiffness(const Ligament& ligament, const PullLine& line, const TwoBodyWrench& out) {
  if (ligament.law.slack_length() == 0) return line.stiffness * Mat3::Identity();
  if (out.length == 0) return Mat3::Zero();
  const Vec3 u = line.d / out.length;
  const double across = out.force / out.length;
  return across * Mat3::Identity() + (line.stiffness - across) * (u * u.transpose());
}

/// The derivative of the wrenches for k = dt/dd: J_row^T k J_column, block by block; [r_row]x k = -(k [r_row]x)^T.
void set_stiffness(const PullLine& line, const Mat3& k, WhichMove moves, TwoBodyWrench& out) {
  const Mat3 s[2] = {skew(line.r_A), skew(line.r_B)};
  const Mat3 turned[2] = {k * s[0], k * s[1]};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      if (!moves[i] || !moves[j]) continue;
      const double sign = i == j ? -1 : 1;
      auto block = out.stiffness.block<6, 6>(6 * i, 6 * j);
      block.topLeftCorner<3, 3>() = sign * k;
      block.topRightCorner<3, 3>() = -sign * turned[j];
      block.bottomLeftCorner<3, 3>() = -sign * turned[i].transpose();
      block.bottomRightCorner<3, 3>() = -sign * s[i].lazyProduct(turned[j]);
    }
  // The lever arms turn with their bodies: (w x r) x t = [t]x [r]x w.
  const Mat3 t = skew(line.t);
  if (moves.a) out.stiffness.block<3, 3>(3, 3) += t.lazyProduct(s[0]);
  if (moves.b) out.stiffness.block<3, 3>(9, 9) -= t.lazyProduct(s[1]);
}

}  // namespace

void TautLine::evaluate(const Pose& X_WA, const Pose& X_WB, double tension, double along, TwoBodyWrench& out,
                        WhichMove moves) const {
  PullLine line;
  line.r_A = X_WA.R * p_A;
  line.r_B = X_WB.R * p_B;
  line.d = (X_WB.p - X_WA.p) + (line.r_B - line.r_A);
  out.length = line.d.norm();
  out.force = tension;
  const Vec3 u = out.length > 0 ? Vec3(line.d / out.length) : Vec3::Zero();
  const double across = out.length > 0 ? tension / out.length : 0;
  line.t = tension * u;
  set_wrenches(line, out);
  set_stiffness(line, across * Mat3::Identity() + (along - across) * (u * u.transpose()), moves, out);
}

bool Ligament::evaluate_wrench(const Pose& X_WA, const Pose& X_WB, TwoBodyWrench& out) const {
  PullLine line;
  return pull(*this, X_WA, X_WB, LigamentLaw::kByLength, line, out);
}

bool Ligament::evaluate(const Pose& X_WA, const Pose& X_WB, TwoBodyWrench& out, int piece, WhichMove moves) const {
  PullLine line;
  if (!pull(*this, X_WA, X_WB, piece, line, out)) {
    out.stiffness.setZero();
    return false;
  }
  set_stiffness(line, line_stiffness(*this, line, out), moves, out);
  return true;
}

}  // namespace genu
