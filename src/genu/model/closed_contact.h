// A rigid contact that stays closed during motion: one constraint, gap = 0, with its two contact points eliminated.
#pragma once

#include "genu/model/state.h"

namespace genu {

struct ClosedContact {
  double gap = 0;                   ///< m
  Vec12 gradient = Vec12::Zero();   ///< d gap / d twist of [a; b]; also the wrench of a unit normal force
  Mat12 curvature = Mat12::Zero();  ///< d gradient / d twist with the points following; v^T curvature v is the
                                    ///< curvature term of gap''
};

/// Moves both points of `contact` along their surfaces until they face each other at the poses of `state` (closure and
/// tangency, contact_equations.h), and evaluates the gap there. False where a surface ends, or where the surfaces
/// conform so that no nearest point is unique; `contact` is then unspecified.
[[nodiscard]] bool evaluate_closed(const JointModel& model, const State& state, ActiveContact& contact,
                                   ClosedContact& out);

/// [twist of body a; twist of body b] of the pair from the twists of all moving bodies (6 each); 0 for a fixed body.
Vec12 twist_at(const JointModel& model, const ActiveContact& contact, const VecX& twist);

/// Writes a gradient over those two twists into row `row` of `out`, which covers all moving bodies.
void set_row(const JointModel& model, const ActiveContact& contact, const Vec12& gradient, Eigen::Index row, MatX& out);

}  // namespace genu
