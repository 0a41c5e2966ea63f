// A rigid contact that stays closed while its bodies move: one constraint, gap = 0, with its two points eliminated.
#pragma once

#include "genu/model/state.h"

namespace genu {

struct ClosedContact {
  double gap = 0;                   ///< m
  Vec12 gradient = Vec12::Zero();   ///< d gap / d twist of [a; b]: the wrench of a unit normal force too
  Mat12 curvature = Mat12::Zero();  ///< d gradient / d twist, the points following: what turns into v^T curvature v
};

/// Moves both points of `contact` along their surfaces to where these face each other at the poses of `state` (closure
/// and tangency, contact_equations.h), and evaluates the gap there. False where a surface ends, or where the surfaces
/// conform so that no single point is nearest; `contact` is then unspecified.
bool evaluate_closed(const JointModel& model, const State& state, ActiveContact& contact, ClosedContact& out);

/// [twist of the body of the pair's first surface; of its second], of all moving bodies' twists (6 each); fixed: 0.
Vec12 twist_at(const JointModel& model, const ActiveContact& contact, const VecX& twist);

/// Sets a row of `out`, over all moving bodies' twists, from one over those two.
void set_row(const JointModel& model, const ActiveContact& contact, const Vec12& gradient, Eigen::Index row, MatX& out);

}  // namespace genu
