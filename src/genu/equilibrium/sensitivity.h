// How a solved pose answers to a parameter: R(x, p) = 0 gives dx/dp = -J^-1 dR/dp, one back-substitution with the
// Jacobian that Newton's method used. The contacts that carry load stay closed and those that are open stay open, so a
// derivative at the very pose where one opens or closes is one-sided.
#pragma once

#include <vector>

#include "genu/equilibrium/newton_step.h"
#include "genu/equilibrium/pose_point.h"
#include "genu/model/grood_suntay.h"
#include "genu/model/parameter_rates.h"

namespace genu {

/// Per SI unit of the parameter, everything in SI. What has no derivative is NaN.
struct LigamentMotion {
  double length, strain, force;
};
struct ContactMotion {
  double force, gap;
  Vec3 a, b;  ///< of the contact points, in the frames of their bodies
};

class Sensitivity {
 public:
  /// Both must outlive this.
  Sensitivity(const PlacedScene& scene, const JointModel& model) : scene_(&scene), model_(&model), step_(model) {}

  /// Factors the Jacobian at a pose, which is kept by reference. False where a derivative does not exist: the pose is
  /// not solved, or not determined (a motion costs no force, a force can be traded for another), or a ligament stays at
  /// a jump of its law.
  bool factor(const PosePoint& point);

  /// The motion of the pose with a parameter; what follows is about the last one.
  void differentiate(const Parameter& parameter);

  const Correction& motion() const { return motion_; }
  double coordinate(const CoordinateRef& c) const;
  double quantity(const QuantityRef& q) const;
  /// Of the multiplier of what is prescribed; NaN where this pose does not prescribe it.
  double reaction(const QuantityRef& q) const;
  /// Of joint_reaction().
  Vec6 held_reaction(int joint) const;
  /// Of grood_suntay() of a joint that describes it; empty where there is no floating axis.
  std::optional<KneeMotion> clinical(int joint) const;
  LigamentMotion ligament(int index) const;
  /// Of State::contacts[index] and Balanced::open[index].
  ContactMotion closed(std::size_t index) const;
  ContactMotion open(std::size_t index) const;
  double load_scale(int load) const;

 private:
  const State& state() const { return point_->pose.state; }
  const Pose& pose(int body) const { return state().poses[static_cast<std::size_t>(body)]; }
  Vec6 twist(int body) const;
  Vec12 twists(int body_a, int body_b) const;

  const PlacedScene* scene_;
  const JointModel* model_;
  NewtonStep step_;
  const PosePoint* point_ = nullptr;
  Parameter parameter_;
  Linearization here_, rate_;
  Correction motion_;
  std::vector<JointPoint> joints_;
};

}  // namespace genu
