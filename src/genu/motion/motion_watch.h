// How far two bodies move as the one sees the other: what need not be looked at for contact meanwhile.
#pragma once

#include "genu/motion/equations_of_motion.h"

namespace genu {

class MotionWatch {
 public:
  MotionWatch(const JointModel& model, int body_a, int body_b, const Surface& a, const Surface& b);

  /// m: how far any point of the one surface goes as the other's body sees it, at most: there and back too, as the
  /// speeds at both ends tell.
  double way(const MotionPoint& from, const MotionPoint& to) const;

  double unwatched = 0;  ///< m: how far they may move between two looks while they touch
  double clearance = 0;  ///< m: gaps of what is not held were no smaller at the last look
  double travelled = 0;  ///< m: since then, at most

 private:
  double speed(const MotionPoint& point) const;

  const JointModel* model_;
  int mover_, seer_;  ///< bodies: points of the surface on `mover_` are what moves
  double reach_ = 0;  ///< m: how far these lie from that body's origin, at most
};

}  // namespace genu
