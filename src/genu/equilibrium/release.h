// The linearization of a pose without its unilateral parts: contacts without force, and laws at a nonsmooth point.
#pragma once

#include <vector>

#include "genu/model/linearization.h"

namespace genu {

/// A plane through the pose in the space of twists (6B). closed: no motion may cross it. Else the stiffness gains slope
/// * wrench * gradient^T, with different slopes on the two sides. drop: a force falls beyond it, and a motion that
/// crosses it continues.
struct ReleasedPlane {
  enum class Kind { slope_change, closed, drop };
  VecX gradient;                ///< rate at which a twist crosses it
  VecX wrench = {};             ///< of a change of stiffness
  double below = 0, above = 0;  ///< slopes of a change of stiffness
  Kind kind = Kind::slope_change;
};

struct Released {
  bool any = false;  ///< whether anything was released
  Linearization at;  ///< without the released parts
  std::vector<ReleasedPlane> planes;
  /// k x 6B: rows that contacts without force along a line or an area also block while closed. Their gap alone does not
  /// state how far one must open to free them.
  MatX conforming;
  std::vector<int> idle_layers;  ///< layers with no or hardly any load: touching, or far apart
  double cancelled = 0;          ///< J: size of the terms removed from the stiffness, in the metric of stability
};

/// Whether anything may be released; needs no equations. `layer_loads` (N): of this pose or of one beside it.
/// `residual`: of the pose, scaled.
bool may_release(const JointModel& model, const State& state, const Target& target,
                 const std::vector<double>& layer_loads, double residual);

/// `touching`: contacts at gap 0 without force, besides those of `state`. The accuracy of the pose (pose_accuracy.h)
/// decides which forces count as zero and which points as nonsmooth.
void release(const JointModel& model, const State& state, const std::vector<ActiveContact>& touching,
             const Target& target, Released& out);

}  // namespace genu
