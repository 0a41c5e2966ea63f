// How well a solved pose and its forces are known: to what Newton's method would still correct, to what it accepts, and
// to the rounding of coordinates. No nearer can a force be told from none, a length from a break, two rows from one.
#pragma once

#include <vector>

#include "genu/model/linearization.h"
#include "genu/model/nonsmooth_points.h"

namespace genu {

class PoseAccuracy {
 public:
  /// Of the pose that `at` was linearized at.
  PoseAccuracy(const JointModel& model, const Target& target, const Linearization& at);

  /// N: what pulls or presses with no more may not.
  double force() const;
  /// The same of contact `c`, whose bodies are held as stiffly as they are; where forces can be traded for one another
  /// each of them is known to nothing.
  double of_contact(std::size_t c) const;
  /// The same of a multiplier that is a force.
  double of_multiplier(Eigen::Index i) const;

  /// What kinks the pose cannot be told from.
  NonsmoothReach reach() const;

  /// How far the gradients of what is held may be off, in the metric of stability and of rows of norm 1: where surfaces
  /// are curved by no more than its length, as far as the pose is; never more than the widest reach.
  double of_rows() const;

  /// N: at no pose solved to this (scaled) residual is more than this none.
  static double least_told(const JointModel& model, double residual);
  /// At no such pose is it wider.
  static NonsmoothReach widest_reach(const JointModel& model, double residual);

 private:
  double also(double correction, double stiffest) const;

  NonsmoothReach widest_;
  double force_ = 0, length_ = 0, rounding_ = 0;  // length_: m, what Newton's method accepts
  bool known_ = false;                            // the correction that is left
  VecX twist_, multipliers_, contact_forces_;
  std::vector<double> stiffest_;  // N/m, of the bodies of each contact
  double stiffest_of_all_ = 0;
};

}  // namespace genu
