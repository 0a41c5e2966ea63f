// When an elastic layer begins to carry during a motion.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "genu/motion/motion_watch.h"

namespace genu {

class LayerOnset {
 public:
  explicit LayerOnset(const JointModel& model);

  using PointAt = std::function<bool(double time, MotionPoint& out)>;

  /// Where a layer that carries nothing at `from` begins to, in the step to `to`: there the motion has to begin anew,
  /// for a long step of free flight may end beyond it. Empty where none does. `at` gives the points between.
  std::optional<MotionPoint> first(const MotionPoint& from, const MotionPoint& to, const PointAt& at) const;

 private:
  bool presses(int layer, const MotionPoint& point) const;

  const JointModel& model_;
  std::vector<MotionWatch> watches_;  ///< one a layer
};

}  // namespace genu
