// Where the stiffness of a pose jumps, or a force: breaks of the laws of ligaments, stops of joints, the ends of the
// scales of loads over a coordinate.
#pragma once

#include <vector>

#include "genu/model/state.h"

namespace genu {

/// d wrench / d twist (6B x 6B) is slope * wrench * gradient^T, besides what does not jump.
struct NonsmoothPoint {
  VecX gradient;                ///< 6B: how fast a twist goes beyond it
  VecX wrench;                  ///< 6B: what the slope multiplies
  double below = 0, above = 0;  ///< slopes on both sides of it
  double here = 0;              ///< the one that linearize() takes at the state
  double jump = 0;              ///< N: of a ligament's force, from below to above; the slopes mean nothing then
  bool beyond = false;          ///< of a jump: the state has the force above
  int ligament = -1;            ///< of a jump: whose it is,
  int law_break = 0;            ///< and which of its sharp breaks
};

/// What counts as near: how well a pose is known.
struct NonsmoothReach {
  double least = 0;   ///< of the characteristic length, rad: this near in any case
  double length = 0;  ///< m, rad: and so much more, the rounding of coordinates
  VecX twist = {};    ///< 6B: and what it may still move by; empty: nothing
  double most = 0;    ///< of the characteristic length, rad: never farther, however little is known
  double idle = 0;    ///< N: a ligament that has begun to pull with no more is as good as slack
  double little = 0;  ///< N: one with more is not, however near it is to where it begins
};

/// Those within reach. Of several breaks of one law that are, what lies between them counts for nothing; what a
/// ligament held at a jump does is none.
std::vector<NonsmoothPoint> nonsmooth_points_near(const JointModel& model, const State& state, const Target& target,
                                                  const NonsmoothReach& reach);

/// Whether any break is within reach, even where several together are no kink.
bool any_nonsmooth_point_near(const JointModel& model, const State& state, const Target& target,
                              const NonsmoothReach& reach);

}  // namespace genu
