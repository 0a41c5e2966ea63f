// Onset of contact in an elastic layer during a motion.
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

  /// The point in the step from `from` to `to` where an idle layer begins to carry load. The motion must restart there,
  /// because a long step of free flight may end beyond it. Empty where none does. `at` gives points between.
  std::optional<MotionPoint> first(const MotionPoint& from, const MotionPoint& to, const PointAt& at) const;

 private:
  bool presses(int layer, const MotionPoint& point) const;

  const JointModel& model_;
  std::vector<MotionWatch> watches_;  ///< one per layer
};

}  // namespace genu
