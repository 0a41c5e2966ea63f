// Sensitivity of a solved pose to a parameter: R(x, p) = 0 gives dx/dp = -J^-1 dR/dp, one back-substitution with
// Newton's Jacobian. The active set is fixed: where a contact opens or closes at the pose itself, the derivative is
// one-sided.
#pragma once

#include <vector>

#include "genu/equilibrium/newton_step.h"
#include "genu/equilibrium/pose_point.h"
#include "genu/model/grood_suntay.h"
#include "genu/model/parameter_rates.h"

namespace genu {

/// Per SI unit of the parameter, in SI. NaN where there is no derivative.
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

  /// Factors the Jacobian at a pose, which is kept by reference. False where no derivative exists: the pose is not
  /// solved, it or its forces are not determined, or a ligament is held at a jump of its law.
  [[nodiscard]] bool factor(const PosePoint& point);

  /// The derivative of the pose. All functions below refer to the last parameter given here.
  void differentiate(const Parameter& parameter);

  const Correction& motion() const { return motion_; }
  double coordinate(const CoordinateRef& c) const;
  double quantity(const QuantityRef& q) const;
  /// Of a multiplier (reaction); NaN where this pose does not prescribe the quantity.
  double reaction(const QuantityRef& q) const;
  /// Of joint_reaction().
  Vec6 held_reaction(int joint) const;
  /// Of grood_suntay() of a joint with these coordinates. Empty where the floating axis does not exist.
  std::optional<KneeMotion> clinical(int joint) const;
  LigamentMotion ligament(int index) const;
  /// Of State::contacts[index] and Balanced::open[index].
  ContactMotion closed(std::size_t index) const;
  ContactMotion open(std::size_t index) const;
  double load_scale(int load) const;
  /// N: of the tension of a cable, or of the size of a force toward a point.
  double tension(int load) const;
  /// Of the factor of a load that drives a coordinate; NaN where it drives none.
  double driving_factor(int load) const;

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
