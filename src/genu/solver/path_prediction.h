// Where a path leads next: extrapolated from its tangents at the last two poses.
//
// With one tangent the prediction errs by the square of the step, with two by its cube. A third was tried and saved no
// iteration: points of contact on curved surfaces err by the cube in any case.
#pragma once

#include "genu/model/correction.h"

namespace genu {

/// How fast a path moves the bodies: the sum of their speeds, in characteristic lengths and rad per unit of t.
double path_speed(const JointModel& model, const Correction& tangent);

class PathPrediction {
 public:
  explicit PathPrediction(const JointModel& model) : model_(&model) {}

  /// Forgets what is behind: another step, other contacts.
  void forget() { bends_ = false; }

  /// The path has gone on by `span` (> 0) of t, from a pose with tangent `from` to one with tangent `to`: what drove
  /// and touched it then does so still.
  void went_on(double span, const Correction& from, const Correction& to);

  /// The state `h` of t beyond the last, `state`, with the tangent `tangent`. False, with `out` unspecified, where a
  /// contact point would leave what is known of its surface.
  bool at(const State& state, const Correction& tangent, double h, State& out);

 private:
  const JointModel* model_;
  Correction bend_, way_;
  double span_ = 0;  ///< of t: over which the tangent changed by bend_
  bool bends_ = false;
};

}  // namespace genu
