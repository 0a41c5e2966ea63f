#include "genu/model/ligament.h"

#include <Eigen/Geometry>

namespace genu {

namespace {

/// Lever arms and the pull t on A, needed for the stiffness.
struct PullLine {
  Vec3 r_A, r_B;  ///< from the bodies' origins to the ends, world axes, m
  Vec3 d;         ///< from the end on A to the end on B, m
  Vec3 t;         ///< pull on A, N
  double stiffness = 0;
};

void set_wrenches(const PullLine& line, WhichMove moves, TwoBodyWrench& out) {
  if (moves.a) out.on_a << line.t, line.r_A.cross(line.t);
  if (moves.b) out.on_b << -line.t, -line.r_B.cross(line.t);
}

bool pull(const LigamentLaw& law, const TautLine& taut, const Pose& X_WA, const Pose& X_WB, int piece, WhichMove moves,
          PullLine& line, TwoBodyWrench& out) {
  line.r_A = X_WA.R * taut.p_A;
  line.r_B = X_WB.R * taut.p_B;
  line.d = (X_WB.p - X_WA.p) + (line.r_B - line.r_A);
  out.length = line.d.norm();
  out.strain = law.strain(out.length);
  const bool by_length = piece == LigamentLaw::kByLength;
  const bool slack = by_length ? out.length <= law.slack_until() : law.is_slack(piece);
  if (slack) {
    out.on_a.setZero();
    out.on_b.setZero();
    out.force = out.energy = 0;
    return false;
  }
  const LawValue value = law.evaluate(out.length, piece);
  out.force = value.force;
  out.energy = value.energy;
  line.stiffness = value.stiffness;
  line.t = out.length > 0 ? Vec3(value.force / out.length * line.d) : Vec3::Zero();
  set_wrenches(line, moves, out);
  return true;
}

/// Adds factor [r]x, entry by entry.
template <typename Block>
void add_cross(double factor, const Vec3& r, Block block) {
  block(0, 1) -= factor * r.z(), block(1, 0) += factor * r.z();
  block(0, 2) += factor * r.y(), block(2, 0) -= factor * r.y();
  block(1, 2) -= factor * r.x(), block(2, 1) += factor * r.x();
}

/// The derivative of the wrenches for dt/dd = across 1 + extra u u^T, block by block: J_row^T (dt/dd) J_column, with
/// J^T u = [u; r x u] and [a]x [b]x = b a^T - (a . b) 1. Scalar code: entries written singly and read in pairs stall
/// the processor.
void set_stiffness(const PullLine& line, const Vec3& u, double across, double extra, WhichMove moves,
                   TwoBodyWrench& out) {
  const Vec3 r[2] = {line.r_A, line.r_B}, g[2] = {r[0].cross(u), r[1].cross(u)};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      if (!moves[i] || !moves[j]) continue;
      const double k = i == j ? -extra : extra, c = i == j ? -across : across, both = c * r[i].dot(r[j]);
      auto block = out.stiffness.block<6, 6>(6 * i, 6 * j);
      for (int n = 0; n < 3; ++n)
        for (int m = 0; m < 3; ++m) {
          block(m, n) = k * u[m] * u[n] + (m == n ? c : 0);
          block(m, n + 3) = k * u[m] * g[j][n];
          block(m + 3, n) = k * g[i][m] * u[n];
          block(m + 3, n + 3) = k * g[i][m] * g[j][n] - c * r[j][m] * r[i][n] + (m == n ? both : 0);
        }
      add_cross(-c, r[j], block.topRightCorner<3, 3>());
      add_cross(c, r[i], block.bottomLeftCorner<3, 3>());
    }
  // The lever arms rotate with their bodies: (w x r) x t = [t]x [r]x w.
  for (int i = 0; i < 2; ++i) {
    if (!moves[i]) continue;
    const double sign = i == 0 ? 1 : -1, along = r[i].dot(line.t);
    auto block = out.stiffness.block<3, 3>(6 * i + 3, 6 * i + 3);
    for (int n = 0; n < 3; ++n)
      for (int m = 0; m < 3; ++m) block(m, n) += sign * (r[i][m] * line.t[n] - (m == n ? along : 0));
  }
}

/// Stiffness of the law along the line, of the tension across it.
void set_stiffness(const LigamentLaw& law, const PullLine& line, WhichMove moves, TwoBodyWrench& out) {
  const Vec3 u = out.length > 0 ? Vec3(line.d / out.length) : Vec3::Zero();
  if (law.slack_length() == 0) return set_stiffness(line, u, line.stiffness, 0, moves, out);
  const double across = out.length > 0 ? out.force / out.length : 0;
  set_stiffness(line, u, across, out.length > 0 ? line.stiffness - across : 0, moves, out);
}

}  // namespace

namespace {

/// Returns the direction from the end on A to that on B.
Vec3 pull_with(const TautLine& taut, const Pose& X_WA, const Pose& X_WB, double tension, WhichMove moves,
               PullLine& line, TwoBodyWrench& out) {
  line.r_A = X_WA.R * taut.p_A;
  line.r_B = X_WB.R * taut.p_B;
  line.d = (X_WB.p - X_WA.p) + (line.r_B - line.r_A);
  out.length = line.d.norm();
  out.force = tension;
  const Vec3 u = out.length > 0 ? Vec3(line.d / out.length) : Vec3::Zero();
  line.t = tension * u;
  set_wrenches(line, moves, out);
  return u;
}

}  // namespace

void TautLine::evaluate(const Pose& X_WA, const Pose& X_WB, double tension, double along, TwoBodyWrench& out,
                        WhichMove moves) const {
  PullLine line;
  const Vec3 u = pull_with(*this, X_WA, X_WB, tension, moves, line, out);
  const double across = out.length > 0 ? tension / out.length : 0;
  set_stiffness(line, u, across, along - across, moves, out);
}

void TautLine::evaluate_wrench(const Pose& X_WA, const Pose& X_WB, double tension, TwoBodyWrench& out,
                               WhichMove moves) const {
  PullLine line;
  pull_with(*this, X_WA, X_WB, tension, moves, line, out);
}

bool evaluate_straight_wrench(const LigamentLaw& law, const TautLine& taut, const Pose& X_WA, const Pose& X_WB,
                              TwoBodyWrench& out, int piece, WhichMove moves) {
  PullLine line;
  return pull(law, taut, X_WA, X_WB, piece, moves, line, out);
}

bool evaluate_straight(const LigamentLaw& law, const TautLine& taut, const Pose& X_WA, const Pose& X_WB,
                       TwoBodyWrench& out, int piece, WhichMove moves) {
  PullLine line;
  if (!pull(law, taut, X_WA, X_WB, piece, moves, line, out)) {
    out.stiffness.setZero();
    return false;
  }
  set_stiffness(law, line, moves, out);
  return true;
}

}  // namespace genu
