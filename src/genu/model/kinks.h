// Where the stiffness of a pose jumps, as its forces do not: breaks of the laws of ligaments, stops of joints, the ends
// of the scales of loads over a coordinate.
#pragma once

#include <vector>

#include "genu/model/state.h"

namespace genu {

/// d wrench / d twist (6B x 6B) is slope * wrench * gradient^T, besides what does not jump.
struct Kink {
  double past = 0;              ///< m or rad: how far beyond it the pose is; negative: before it
  double unit = 1;              ///< m or rad: the characteristic length, or 1 rad
  VecX gradient = {};           ///< 6B: of `past`
  VecX wrench = {};             ///< 6B: what the slope multiplies
  double below = 0, above = 0;  ///< slopes on both sides of it
  double here = 0;              ///< the one that linearize() takes at the state
  double force = 0;             ///< N: of a ligament that begins to pull there, and is past it; else 0
};

/// Those that the pose is no further from than `near` (fraction of their unit), and ligaments that are taut and pull
/// with no more than `force` (N). Jumps of the force are none, nor what a ligament held at one does.
std::vector<Kink> kinks_near(const JointModel& model, const State& state, const Target& target, double near,
                             double force);

}  // namespace genu
