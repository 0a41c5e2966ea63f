// The equations of motion of a joint as y' = f(t, y).
//
//   M a + b = W + J^T mu,   J a = -J' v
// with W all forces of the quasi-static system (linearize) and dampers, J the gradient of what joints hold, mu what
// that costs, M and b of inertia.h. y holds the pose of each moving body (position, quaternion), then its twist, then
// what loads have done and dampers have taken (J).
//
// f is evaluated at the state on the constraints nearest to y, P(y): f = f(P(y)). Nothing pulls y back and nothing
// drives it away, so an error of y across the constraints stays as small as the steps made it (their tolerance), adds
// no stiffness, and what is read from y, P(y), is on the constraints to rounding. The same P normalises quaternions,
// which have no singular orientation.
#pragma once

#include <vector>

#include "genu/model/damping.h"
#include "genu/model/linearization.h"
#include "genu/solver/ode_integrator.h"

namespace genu {

/// A moment of a motion.
struct MotionPoint {
  double time = 0;  ///< s
  State state;      ///< its multipliers are those of the motion: what joints exert
  VecX twist;       ///< 6 for each moving body
  VecX acceleration;
  std::vector<DamperMode> modes;  ///< of every ligament
  double load_work = 0;           ///< J, done by loads since the start
  double dissipated = 0;          ///< J, taken by dampers since the start
  double residual = 0;            ///< of the constraints, lengths over the scale of length, and angles (rad)
  double drift = 0;               ///< how far y lay from the constraints, the same
};

class EquationsOfMotion {
 public:
  /// `tolerance`: error of one step, of the scale of length, in rad, and of speeds (plus a scale of 1/s).
  EquationsOfMotion(const JointModel& model, double tolerance);

  Eigen::Index size() const { return 13 * model_.moving_count + 2; }

  /// y at a point. Velocities that the constraints forbid are taken out later, by P.
  VecX pack(const MotionPoint& point) const;

  /// The point P(y), its accelerations and multipliers included; false where there is none near.
  bool read(double t, OdeSystem::Values y, MotionPoint& out);

  /// f; false where it cannot be evaluated.
  bool rate(double t, OdeSystem::Values y, Eigen::Ref<VecX> out);

  void weights(OdeSystem::Values y, Eigen::Ref<VecX> out) const;

  /// From here on: coordinates are continued from those of `point`.
  void continue_from(const MotionPoint& point) { near_ = point.state; }

  /// The pieces of ligaments' laws and modes of their dampers, fixed while steps are taken.
  State& pieces() { return near_; }
  std::vector<DamperMode>& modes() { return modes_; }

  /// Whether the mass that constraints leave to move is none in some direction.
  bool massless(const MotionPoint& point);

 private:
  bool project(MotionPoint& point);
  void project_twist(MotionPoint& point);
  bool accelerate(MotionPoint& point);
  void set_gradient(const MotionPoint& point);
  double residual() const;
  VecX metric_step(const VecX& rows) const;

  const JointModel& model_;
  double tolerance_;
  State near_;
  std::vector<DamperMode> modes_;
  Target target_;
  Linearization constraints_, forces_;
  VecX metric_, row_scale_, wrench_;
  MatX J_, system_;
  Eigen::LLT<MatX> gram_;
  MotionPoint point_;
  double power_ = 0;  ///< W, that dampers take
};

}  // namespace genu
