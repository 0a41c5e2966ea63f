// How accurately a solved pose and its forces are known: the Newton correction that is left, the tolerance of Newton's
// method, and the rounding of coordinates. Within these a force cannot be told from zero, a length from a break, or two
// dependent rows from one.
#pragma once

#include <vector>

#include "genu/model/linearization.h"
#include "genu/model/nonsmooth_points.h"

namespace genu {

class PoseAccuracy {
 public:
  /// For the pose that `at` was linearized at.
  PoseAccuracy(const JointModel& model, const Target& target, const Linearization& at);

  /// N: a force up to this may be zero.
  double force() const;
  /// The same for contact `c`; includes the stiffness with which its bodies are held. Where forces are statically
  /// indeterminate it is the widest.
  double of_contact(std::size_t c) const;
  /// The same for a multiplier that is a force.
  double of_multiplier(Eigen::Index i) const;

  /// The reach within which the pose cannot be told from a nonsmooth point.
  NonsmoothReach reach() const;

  /// Error of the gradients of constraints and contacts, in the metric of stability, for rows of norm 1. Where surfaces
  /// are curved by no more than 1 / length, it is the error of the pose. At most the widest reach.
  double of_rows() const;

  /// N: an upper bound of force() over all poses solved to this scaled residual.
  static double least_told(const JointModel& model, double residual);
  /// An upper bound of reach() over all such poses.
  static NonsmoothReach widest_reach(const JointModel& model, double residual);

 private:
  double also(double correction, double stiffest) const;

  NonsmoothReach widest_;
  double force_ = 0, length_ = 0, rounding_ = 0;  // length_: m, tolerance of Newton's method
  bool known_ = false;                            // the remaining correction is known
  VecX twist_, multipliers_, contact_forces_;
  std::vector<double> stiffest_;  // N/m, of the bodies of each contact
  double stiffest_of_all_ = 0;
};

}  // namespace genu
