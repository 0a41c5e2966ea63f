// A pose without what holds nothing at it, or one way only: what is idle let go, what jumps taken out.
#pragma once

#include <vector>

#include "genu/model/linearization.h"

namespace genu {

/// A plane through the pose among twists (6B). Closed: none may go beyond it. Else the stiffness gains slope * wrench *
/// gradient^T, another slope beyond it. A drop: beyond it a force falls, and what goes there goes on.
struct ReleasedPlane {
  enum class Kind { kink, closed, drop };
  VecX gradient;                ///< how fast a twist goes beyond it
  VecX wrench = {};             ///< of a kink
  double below = 0, above = 0;  ///< of a kink, slopes
  Kind kind = Kind::kink;
};

struct Released {
  bool any = false;  ///< whether there is anything of that
  Linearization at;  ///< without it
  std::vector<ReleasedPlane> planes;
  /// k x 6B: what idle contacts along a line or an area let no motion do while they are closed: how far one must open
  /// for it their gap alone does not say.
  MatX conforming;
  std::vector<int> idle_layers;  ///< that carry nothing, or hardly: touching or wide open
  double cancelled = 0;          ///< J: the size of what was taken out of the stiffness, in the metric of stability
};

/// Whether there may be anything of that, told without the equations. `layer_loads` (N): of this pose or one beside it;
/// `residual`: to what the pose is solved, scaled.
bool may_release(const JointModel& model, const State& state, const Target& target,
                 const std::vector<double>& layer_loads, double residual);

/// `touching`: contacts that are closed and carry nothing, besides those of `state`. How well the pose is
/// known (pose_accuracy.h) says what is told from none, or from a kink.
void release(const JointModel& model, const State& state, const std::vector<ActiveContact>& touching,
             const Target& target, Released& out);

}  // namespace genu
