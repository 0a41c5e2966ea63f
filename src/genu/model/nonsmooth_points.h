// Nonsmooth points: where the stiffness of a pose, or a force, jumps. These are breaks of ligament laws, stops of
// joints, and the ends of load scales over a coordinate.
#pragma once

#include <vector>

#include "genu/model/state.h"

namespace genu {

/// The jumping part of d wrench / d twist (6B x 6B) is slope * wrench * gradient^T.
struct NonsmoothPoint {
  VecX gradient;                ///< 6B: rate at which a twist crosses it
  VecX wrench;                  ///< 6B: factor of the slope
  double below = 0, above = 0;  ///< slopes on both sides of it
  double here = 0;              ///< the slope that linearize() uses at the state
  double jump = 0;              ///< N: jump of a ligament's force, from below to above; the slopes are unused then
  bool beyond = false;          ///< of a jump: the state has the force above
  int ligament = -1;            ///< of a jump: the ligament,
  int law_break = 0;            ///< and the index of its sharp break
};

/// The distance that counts as near: the accuracy of a pose.
struct NonsmoothReach {
  double least = 0;   ///< of the characteristic length, rad: always near
  double length = 0;  ///< m, rad: added, the rounding of coordinates
  VecX twist = {};    ///< 6B: added, the remaining motion of the pose; empty: none
  double most = 0;    ///< of the characteristic length, rad: never near beyond this
  double idle = 0;    ///< N: a ligament with at most this tension counts as slack
  double little = 0;  ///< N: a ligament with more tension never does, however near its break is
};

/// The points within reach. If several breaks of one law are, only the outermost stiffnesses count. Ligaments held at a
/// jump are skipped.
std::vector<NonsmoothPoint> nonsmooth_points_near(const JointModel& model, const State& state, const Target& target,
                                                  const NonsmoothReach& reach);

/// Whether any break is within reach, even where several together are smooth.
bool any_nonsmooth_point_near(const JointModel& model, const State& state, const Target& target,
                              const NonsmoothReach& reach);

}  // namespace genu
