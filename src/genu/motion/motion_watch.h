// Bounds the relative motion of two bodies, to skip searches for contact.
#pragma once

#include "genu/motion/equations_of_motion.h"

namespace genu {

class MotionWatch {
 public:
  MotionWatch(const JointModel& model, int body_a, int body_b, const Surface& a, const Surface& b);

  /// m: upper bound of the path length of any point of the one surface in the frame of the other body, from the speeds
  /// at both ends; includes motion to and fro.
  double way(const MotionPoint& from, const MotionPoint& to) const;

  double unwatched = 0;  ///< m: motion allowed between two searches while they touch
  double clearance = 0;  ///< m: smallest gap without a contact at the last search
  double travelled = 0;  ///< m: motion since then, upper bound

 private:
  double speed(const MotionPoint& point) const;

  const JointModel* model_;
  int mover_, seer_;  ///< bodies: points of the surface on `mover_` are what moves
  double reach_ = 0;  ///< m: largest distance of these from that body's origin
};

}  // namespace genu
