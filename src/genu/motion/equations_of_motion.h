// The equations of motion of a joint as y' = f(t, y).
//
//   M a + b = W + J^T mu,   J a = c'' - J' v
// with W all forces of the quasi-static system (linearize) and dampers, J the gradient of the constraints, mu what they
// cost, M and b of inertia.h. Constraints are what is prescribed (its course c over time), what joints hold, and the
// gap of each contact that is closed (mu is its force). y holds the pose of each moving body (position, quaternion),
// then its twist, then what loads and drives have done, what dampers and impacts have taken, and in a scene with
// elastic layers what these have done (J).
//
// f is evaluated at the state on the constraints nearest to y, P(y): f = f(P(y)). Nothing pulls y back and nothing
// drives it away, so an error of y across the constraints stays as small as the steps made it (their tolerance), adds
// no stiffness, and what is read from y, P(y), is on the constraints to rounding. The same P normalises quaternions,
// which have no singular orientation.
//
// Where hinges are all that holds the bodies, y holds their angles and rates instead (hinged_motion.h), and the system
// above is solved only for what is written down.
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

/// A moment of a motion.
struct MotionPoint {
  double time = 0;  ///< s
  State state;      ///< its multipliers and contact forces are those of the motion
  VecX twist;       ///< 6 for each moving body
  VecX acceleration;
  std::vector<DamperMode> modes;  ///< of every ligament
  double load_work = 0;           ///< J, done by loads and drives since the start
  double dissipated = 0;          ///< J, taken by dampers and impacts since the start
  double layer_work = 0;          ///< J, done by elastic layers since the start
  std::vector<double> pair_gap;   ///< m, of each rigid pair, where a row is written
  double residual = 0;            ///< of the constraints, lengths over the scale of length, and angles (rad)
  double drift = 0;               ///< how far y lay from the constraints, the same
};

class EquationsOfMotion {
 public:
  /// `tolerance`: error of one step, of the scale of length, in rad, and of speeds (plus a scale of 1/s).
  EquationsOfMotion(const JointModel& model, double tolerance);

  Eigen::Index size() const { return hinged_ ? hinged_->size() : 13 * model_.moving_count + energies_; }

  /// y at a point. Velocities that the constraints forbid are taken out later, by P.
  VecX pack(const MotionPoint& point) const;

  /// The point P(y), its accelerations and multipliers included; false where there is none near.
  bool read(double t, OdeSystem::Values y, MotionPoint& out);

  /// The poses, coordinates and twists that y means; more of it where that is not cheaper.
  bool see(double t, OdeSystem::Values y, MotionPoint& out);

  /// Completes a point that see() has given: accelerations and multipliers.
  bool finish(MotionPoint& point) { return !hinged_ || complete(point); }

  /// f; false where it cannot be evaluated.
  bool rate(double t, OdeSystem::Values y, Eigen::Ref<VecX> out);

  void weights(OdeSystem::Values y, Eigen::Ref<VecX> out) const;

  /// From here on: coordinates and contacts are continued from those of `point`, and the same contacts are closed.
  void continue_from(const MotionPoint& point) { near_ = point.state; }

  /// Until the next stop: loads and drives are seen as they are between these times, also at both ends, where they may
  /// jump.
  void set_span(double from, double to);

  /// What is prescribed at a time (s).
  Target target_at(double t);

  /// Completes a point of which time, poses, twist and contacts are known: moves it onto its constraints, and sets its
  /// accelerations, multipliers and contact forces. False where there is none near.
  bool complete(MotionPoint& point);

  /// Of a completed point: how fast the gap of a contact that is not closed, but touches, changes and how fast that
  /// does (m/s, m/s^2). Empty where the contact has no single point.
  struct Opening {
    double rate = 0, acceleration = 0;
    double rate_scale = 0, acceleration_scale = 0;  ///< what rounding of each is measured in
  };
  std::optional<Opening> opening(const MotionPoint& point, ActiveContact contact) const;

  /// Speeds after an inelastic impact in which all contacts of `point` stay closed and drives keep their rates.
  /// `impulses`: N s or N m s of each constraint, the contacts' last. What is lost is added to `dissipated`.
  bool strike(MotionPoint& point, VecX& impulses);

  /// The pieces of ligaments' laws and modes of their dampers, fixed while steps are taken.
  State& pieces() { return near_; }
  std::vector<DamperMode>& modes() { return modes_; }

  /// Leaves off summing elastic layers once `cancelled` says so: nothing can be evaluated from then on.
  void stop_when(const Cancelled& cancelled) { stop_layers_when(cancelled, forces_); }

  /// Sums elastic layers more finely from here on where their error at the point evaluated last, `point`, asks for it
  /// (layer_levels.h). True where any is.
  bool raise_layers(MotionPoint& point);

  /// Whether the mass that constraints leave to move is none in some direction.
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
  std::unique_ptr<HingedMotion> hinged_;  ///< where hinges are all that holds the bodies
  State near_;
  std::vector<DamperMode> modes_;
  Target target_;
  VecX drive_rate_, drive_acceleration_;  ///< of what is prescribed
  double from_, to_;                      ///< s: between stops
  Linearization constraints_, forces_;
  std::vector<ClosedContact> closed_;
  VecX metric_, row_scale_, violation_, wrench_;
  MatX gradient_, J_, system_;  ///< J_: gradient_ scaled
  double mass_ = 1;             ///< kg m^2 or kg, by which system_ is scaled
  std::size_t damper_count_ = 0;
  Eigen::LLT<MatX> gram_;
  MotionPoint point_;
  double dampers_ = 0, layers_ = 0;  ///< W, taken and done
};

}  // namespace genu
