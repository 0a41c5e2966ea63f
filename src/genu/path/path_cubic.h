// Interpolates a path between two poses by the cubic of both poses and their tangents.
#pragma once

#include "genu/model/correction.h"

namespace genu {

class PathCubic {
 public:
  /// `from` and `to` have the same contacts and held ligaments. Tangents are rates per unit of the path's parameter;
  /// `span` (> 0) is its change from `from` to `to`. All arguments must outlive this object.
  PathCubic(const JointModel& model, const State& from, const Correction& tangent_from, const State& to,
            const Correction& tangent_to, double span);

  /// The state at `u` from 0 to 1, with an error of fourth order in the span (second order for contact points on their
  /// surfaces). False where a contact point would leave its surface.
  bool at(double u, State& out);

 private:
  const JointModel& model_;
  const State& from_;
  const Correction& start_;
  double span_;
  Correction way_, end_, here_;  ///< from `from` to `to`; the tangent at `to` as a change of `way_`; at u
};

}  // namespace genu
