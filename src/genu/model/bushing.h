// A bushing: a linear spring between a frame of body A and one of body B, in all six directions.
//
// With X = F_A^-1 F_B of the frames in the world, p its translation and R its rotation, the displacement is q = (p,
// log R), six numbers in the axes of F_A, and the energy q^T K q / 2. Turned by w = w_B - w_A (in F_A), log R changes
// by J^-1 w with the left Jacobian of the rotation vector (Chirikjian and Kyatkin 2001, 10.86):
//   J^-1(t) = 1 - [t]x / 2 + c(|t|) [t]x^2,  c(a) = (1 - (a / 2) cot(a / 2)) / a^2.
// So with d = dq / d[twist of A; twist of B] = G the wrench is -G^T K q, and its derivative -G^T K G - (d G^T) K q,
// both in closed form, for every rotation below half a turn. At half a turn log R has two values.
#pragma once

#include "genu/core/pose.h"
#include "genu/core/types.h"
#include "genu/scene/bushing_def.h"

namespace genu {

struct Bushing {
  std::string name;
  int body_a = -1, body_b = -1;
  Pose frame_a, frame_b;          ///< in the bodies, m
  Mat6 stiffness = Mat6::Zero();  ///< K: N, m, rad
  Mat6 damping = Mat6::Zero();    ///< N s, m, rad: in motion

  /// N, of a displacement by `length` (m) or by 1 rad in the stiffest direction.
  double largest_force(double length) const;
};

/// c(a) and c'(a) / a of the left Jacobian's inverse, for 0 <= a < 2 pi.
struct LogSeries {
  double c = 0, slope = 0;
};
LogSeries log_series(double angle);

/// J^-1(t), 3 x 3.
Mat3 inverse_left_jacobian(const Vec3& t);

/// Values and derivatives of a bushing at two poses.
class BushingPoint {
 public:
  BushingPoint(const Bushing& bushing, const Pose& X_WA, const Pose& X_WB);

  /// q: m, rad; in the axes of frame A.
  const Vec6& displacement() const { return q_; }
  /// G = dq / d[twist of A; twist of B], world axes.
  Eigen::Matrix<double, 6, 12> gradient() const;
  /// [force, moment] on A, then on B, about the bodies' origins, of generalised forces f on q: G^T f.
  Vec12 wrench(const Vec6& f) const;
  /// d wrench(f) / d[twist of A; twist of B] at fixed f. Not symmetric: rotations do not commute.
  Eigen::Matrix<double, 12, 12> wrench_rate(const Vec6& f) const;
  /// The force and moment on B about the origin of frame B, in the axes of frame A: N, N m.
  Vec6 on_frame(const Vec6& f) const;

 private:
  Mat3 R_;            ///< of frame A in the world
  Mat3 J_;            ///< J^-1
  Vec3 turn_;         ///< log R
  Vec3 arm_a_;        ///< from A's origin to that of frame B, world axes
  Vec3 arm_b_;        ///< from B's origin to that of frame B
  double slope_ = 0;  ///< of LogSeries
  double c_ = 0;
  Vec6 q_;
};

/// The bushing of a placed scene.
Bushing make_bushing(const BushingDef& def);

/// J
double energy_of(const Bushing& bushing, const Pose& X_WA, const Pose& X_WB);

}  // namespace genu
