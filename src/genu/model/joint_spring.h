// The spring of a revolute joint: linear about angle 0, stiffer beyond the joint's limits.
#pragma once

#include <limits>

#include "genu/scene/joint_def.h"

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

  /// The change of moment(angle) where the spring's numbers change by those of `change`.
  double moment_rate(double angle, const JointSpring& change) const {
    const double limit = angle > upper ? change.upper : angle < lower ? change.lower : 0;
    return -change.stiffness * angle - change.stop * beyond(angle) + stop * limit;
  }
};

/// The spring of the scene's joint `index`. Each of its numbers is affine in each number of the joint's table.
inline JointSpring make_spring(const JointDef& def, int index) {
  JointSpring spring{.joint = index, .stiffness = def.stiffness};
  if (!def.limits) return spring;
  spring.lower = def.limits->lower;
  spring.upper = def.limits->upper;
  spring.stop = def.limits->stiffness;
  return spring;
}

}  // namespace genu
