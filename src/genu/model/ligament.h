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

/// The straight line between a point of A and one of B under a given tension: a ligament's only line, or one of the
/// lines of its path, which share one tension.
struct TautLine {
  Vec3 p_A = Vec3::Zero();  ///< m, in body A
  Vec3 p_B = Vec3::Zero();  ///< m, in body B

  /// Wrenches and their stiffness for a tension (N) that changes by `along` N for a metre of this line's length; fills
  /// length and force too. 0 where the ends meet: the line has no direction there.
  void evaluate(const Pose& X_WA, const Pose& X_WB, double tension, double along, TwoBodyWrench& out,
                WhichMove moves = {}) const;

  /// The same without the stiffness, which is left as it was.
  void evaluate_wrench(const Pose& X_WA, const Pose& X_WB, double tension, TwoBodyWrench& out,
                       WhichMove moves = {}) const;

  /// m
  double length(const Pose& X_WA, const Pose& X_WB) const { return (X_WB * p_B - X_WA * p_A).norm(); }
};

/// A law along one straight line: wrenches, stiffness and what the results show, for the poses of A and B in the world
/// (either may be fixed: pass its pose and ignore its part). Returns false where the ligament is slack: everything but
/// length and strain is then 0. Where the ends meet and the law still has a force, its direction is undefined: wrench
/// and stiffness are 0 there, except for a spring of slack length 0, which is smooth. With a `piece` the law keeps to
/// that piece. The wrench on a body that does not `move`, and what it would add to the stiffness, are left as they
/// were.
bool evaluate_straight(const LigamentLaw& law, const TautLine& taut, const Pose& X_WA, const Pose& X_WB,
                       TwoBodyWrench& out, int piece = LigamentLaw::kByLength, WhichMove moves = {});

/// The same without the stiffness, which is left as it was.
bool evaluate_straight_wrench(const LigamentLaw& law, const TautLine& taut, const Pose& X_WA, const Pose& X_WB,
                              TwoBodyWrench& out, int piece = LigamentLaw::kByLength, WhichMove moves = {});

}  // namespace genu
