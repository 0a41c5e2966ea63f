// The equations of motion of a joint as y' = f(t, y).
//
//   M a + b = W + J^T mu,   J a = c'' - J' v
//
// W: all forces of the quasi-static system (linearize) and dampers; J: gradient of the constraints; mu: their forces; M
// and b as in inertia.h. Constraints are prescribed coordinates (course c over time), coordinates held by joints, and
// the gaps of closed contacts (mu is the contact force). y holds the pose of each moving body (position, quaternion),
// then its twist, then the work of loads and drives, the energy dissipated by dampers and impacts, and the work of
// elastic layers if there are any (J).
//
// f is evaluated at the state on the constraints nearest to y, P(y): f = f(P(y)). This adds no stiffness and neither
// attracts nor repels y. An error across the constraints stays as small as the integration error, and the output P(y)
// satisfies the constraints to rounding. P also normalises the quaternions, which have no singular orientation.
//
// If hinges alone hold the bodies, y holds their angles and rates instead (hinged_motion.h), and the system above is
// solved for output only.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "genu/model/closed_contact.h"
#include "genu/model/damping.h"
#include "genu/model/linearization.h"
#include "genu/motion/hinged_motion.h"
#include "genu/motion/ode_integrator.h"

namespace genu {

/// The state of a motion at one time.
struct MotionPoint {
  double time = 0;  ///< s
  State state;      ///< its multipliers and contact forces are those of the motion
  VecX twist;       ///< 6 for each moving body
  VecX acceleration;
  std::vector<DamperMode> modes;  ///< of every ligament
  double load_work = 0;           ///< J, done by loads and drives since the start
  double dissipated = 0;          ///< J, dissipated by dampers and impacts since the start
  double layer_work = 0;          ///< J, done by elastic layers since the start
  std::vector<double> pair_gap;   ///< m, of each rigid pair, at output rows
  double residual = 0;            ///< of the constraints: lengths over the length scale, and angles (rad)
  double drift = 0;               ///< distance of y from the constraints, in the same unit
};

class EquationsOfMotion {
 public:
  /// `tolerance`: error of one step, in length scales, rad, and for speeds per second.
  EquationsOfMotion(const JointModel& model, double tolerance);

  Eigen::Index size() const { return hinged_ ? hinged_->size() : 13 * model_.moving_count + energies_; }

  /// y at a point. P later removes velocities that violate the constraints.
  VecX pack(const MotionPoint& point) const;

  /// The point P(y) with accelerations and multipliers. False where there is none near y.
  bool read(double t, OdeSystem::Values y, MotionPoint& out);

  /// The poses, coordinates and twists of y; the full point where that costs no more.
  bool see(double t, OdeSystem::Values y, MotionPoint& out);

  /// Completes a point from see() with accelerations and multipliers.
  bool finish(MotionPoint& point) { return !hinged_ || complete(point); }

  /// f; false where it cannot be evaluated.
  bool rate(double t, OdeSystem::Values y, Eigen::Ref<VecX> out);

  void weights(OdeSystem::Values y, Eigen::Ref<VecX> out) const;

  /// Continues coordinates and contacts from those of `point`, with the same contacts closed.
  void continue_from(const MotionPoint& point) { near_ = point.state; }

  /// Until the next stop: loads and drives take their values between these times, also at both ends, where they may
  /// jump.
  void set_span(double from, double to);

  /// The prescribed values at a time (s).
  Target target_at(double t);

  /// Completes a point with known time, poses, twist and contacts: moves it onto its constraints and sets its
  /// accelerations, multipliers and contact forces. False where no such point is near.
  bool complete(MotionPoint& point);

  /// For a completed point: first and second derivative of the gap of a touching contact that is not closed (m/s,
  /// m/s^2). Empty where the contact has no unique point.
  struct Opening {
    double rate = 0, acceleration = 0;
    double rate_scale = 0, acceleration_scale = 0;  ///< units of their rounding error
  };
  std::optional<Opening> opening(const MotionPoint& point, ActiveContact contact) const;

  /// Velocities after an inelastic impact in which all contacts of `point` stay closed and drives keep their rates.
  /// `impulses`: N s or N m s of each constraint, contacts last. Adds the lost energy to `dissipated`.
  bool strike(MotionPoint& point, VecX& impulses);

  /// The pieces of ligaments' laws and the modes of their dampers, constant within a step.
  State& pieces() { return near_; }
  std::vector<DamperMode>& modes() { return modes_; }

  /// Stops the quadrature of elastic layers once `cancelled` is true: later evaluations fail.
  void stop_when(const Cancelled& cancelled) { stop_layers_when(cancelled, forces_); }

  /// Refines elastic layers from here on where their error at the point evaluated last, `point`, requires it
  /// (layer_levels.h). True where any is refined.
  bool raise_layers(MotionPoint& point);

  /// Whether the mass matrix on the free motions is singular.
  bool massless(const MotionPoint& point);

 private:
  bool unpack(double t, OdeSystem::Values y, MotionPoint& out);
  bool project(MotionPoint& point);
  void project_twist(MotionPoint& point);
  bool accelerate(MotionPoint& point);
  bool set_gradient(MotionPoint& point);
  void set_targets(double t);
  void set_system(const MotionPoint& point);
  void set_masses(const MotionPoint& point);
  void add_forces(const MotionPoint& point);
  VecX asked_rates() const;
  VecX asked_accelerations(const MotionPoint& point) const;
  double residual() const;
  VecX metric_step(const VecX& rows) const;

  const JointModel& model_;
  double tolerance_;
  Eigen::Index energies_;
  std::unique_ptr<HingedMotion> hinged_;  ///< if hinges alone hold the bodies
  State near_;
  std::vector<DamperMode> modes_;
  Target target_;
  VecX drive_rate_, drive_acceleration_;  ///< of prescribed coordinates
  double from_, to_;                      ///< s: between stops
  Linearization constraints_, forces_;
  std::vector<ClosedContact> closed_;
  VecX metric_, row_scale_, violation_, wrench_;
  MatX gradient_, J_, system_;  ///< J_: gradient_ scaled
  double mass_ = 1;             ///< kg m^2 or kg, scale of system_
  std::size_t damper_count_ = 0;
  Eigen::LLT<MatX> gram_;
  MotionPoint point_;
  double dampers_ = 0, layers_ = 0;  ///< W, power of dissipation and of elastic layers
};

}  // namespace genu
