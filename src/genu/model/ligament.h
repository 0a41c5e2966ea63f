// A ligament or spring: a straight line between a point of body A and a point of body B, with a force along it.
//
// With r_A = R_WA p_A, r_B = R_WB p_B, d = (p_WB + r_B) - (p_WA + r_A), L = |d|, u = d / L, the pull on A is t = F(L) u
// and
//   wrench on A = J_A^T t,  wrench on B = -J_B^T t,  J = [1, -[r]x] (the velocity of the point per twist),
//   dt = (F' u u^T + F / L (1 - u u^T)) dd,  dd = J_B dX_B - J_A dX_A,
// and the lever arms turn with their bodies. A wrench is [force, moment about the body's own origin], N and N m, a
// twist as in pose.h; both in world axes.
#pragma once

#include "genu/core/pose.h"
#include "genu/core/types.h"
#include "genu/core/which_move.h"
#include "genu/model/ligament_law.h"

namespace genu {

using Mat12 = Eigen::Matrix<double, 12, 12>;

struct TwoBodyWrench {
  Vec6 on_a = Vec6::Zero();
  Vec6 on_b = Vec6::Zero();
  Mat12 stiffness = Mat12::Zero();  ///< d[on_a; on_b] / d[twist of A; twist of B]; unsymmetric where moments act
  double length = 0;                ///< m
  double strain = 0;                ///< NaN for a spring of slack length 0
  double force = 0;                 ///< N, positive in tension
  double energy = 0;                ///< J
};

/// The straight line between a point of A and one of B under a given tension: the only line of a ligament, or one of
/// its path, whose lines share one tension.
struct TautLine {
  Vec3 p_A = Vec3::Zero();  ///< m, in body A
  Vec3 p_B = Vec3::Zero();  ///< m, in body B

  /// Wrenches and their stiffness for a tension (N) with rate `along` (N per m of this line's length); sets length and
  /// force too. 0 where the ends meet, because the direction is undefined there.
  void evaluate(const Pose& X_WA, const Pose& X_WB, double tension, double along, TwoBodyWrench& out,
                WhichMove moves = {}) const;

  /// The same without the stiffness, which does not change.
  void evaluate_wrench(const Pose& X_WA, const Pose& X_WB, double tension, TwoBodyWrench& out,
                       WhichMove moves = {}) const;

  /// m
  double length(const Pose& X_WA, const Pose& X_WB) const { return (X_WB * p_B - X_WA * p_A).norm(); }
};

/// A law along one straight line: wrenches, stiffness and output values, for the poses of A and B in the world (for a
/// fixed body pass its pose and ignore its part). False where the ligament is slack: then all but length and strain is
/// 0. Where the ends meet under a force, the direction is undefined, and wrench and stiffness are 0, except for a
/// spring of slack length 0, which is smooth. With a `piece` the law stays on that piece. The wrench on a body that
/// does not `move`, and its part of the stiffness, do not change.
bool evaluate_straight(const LigamentLaw& law, const TautLine& taut, const Pose& X_WA, const Pose& X_WB,
                       TwoBodyWrench& out, int piece = LigamentLaw::kByLength, WhichMove moves = {});

/// The same without the stiffness, which does not change.
bool evaluate_straight_wrench(const LigamentLaw& law, const TautLine& taut, const Pose& X_WA, const Pose& X_WB,
                              TwoBodyWrench& out, int piece = LigamentLaw::kByLength, WhichMove moves = {});

}  // namespace genu
