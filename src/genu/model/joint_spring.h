// The spring of a revolute joint: linear about angle 0, and stiffer beyond the joint's limits.
#pragma once

#include <limits>

namespace genu {

struct JointSpring {
  int joint = 0;
  double stiffness = 0;                                     ///< N m / rad, at rest at angle 0
  double lower = -std::numeric_limits<double>::infinity();  ///< rad: limits
  double upper = std::numeric_limits<double>::infinity();
  double stop = 0;  ///< N m / rad, of what lies beyond a limit

  /// rad: how far past a limit, signed; 0 between them.
  double beyond(double angle) const { return angle > upper ? angle - upper : angle < lower ? angle - lower : 0; }

  double moment(double angle) const { return -stiffness * angle - stop * beyond(angle); }    ///< N m
  double slope(double angle) const { return -stiffness - (beyond(angle) != 0 ? stop : 0); }  ///< N m / rad
  double energy(double angle) const {                                                        ///< J
    return (stiffness * angle * angle + stop * beyond(angle) * beyond(angle)) / 2;
  }
};

}  // namespace genu
