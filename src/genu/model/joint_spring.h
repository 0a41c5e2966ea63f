// The spring of a revolute joint: linear about angle 0, stiffer beyond the joint's limits.
#pragma once

#include <limits>

namespace genu {

struct JointSpring {
  int joint = 0;
  double stiffness = 0;                                     ///< N m / rad, zero moment at angle 0
  double lower = -std::numeric_limits<double>::infinity();  ///< rad: limits
  double upper = std::numeric_limits<double>::infinity();
  double stop = 0;  ///< N m / rad, added beyond a limit

  /// rad: signed distance past a limit; 0 between the limits.
  double beyond(double angle) const { return angle > upper ? angle - upper : angle < lower ? angle - lower : 0; }

  double moment(double angle) const { return -stiffness * angle - stop * beyond(angle); }    ///< N m
  double slope(double angle) const { return -stiffness - (beyond(angle) != 0 ? stop : 0); }  ///< N m / rad
  double energy(double angle) const {                                                        ///< J
    return (stiffness * angle * angle + stop * beyond(angle) * beyond(angle)) / 2;
  }
};

}  // namespace genu
