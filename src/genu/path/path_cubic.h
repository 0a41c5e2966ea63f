// Where a path is between two of its poses, as the cubic through both with their tangents predicts it.
#pragma once

#include "genu/model/correction.h"

namespace genu {

class PathCubic {
 public:
  /// `from` and `to` have the same contacts and held ligaments; tangents are changes per unit of the path's parameter,
  /// which is `span` (> 0) from the one to the other. All must outlive this object.
  PathCubic(const JointModel& model, const State& from, const Correction& tangent_from, const State& to,
            const Correction& tangent_to, double span);

  /// At `u` from 0 to 1. Errs with the fourth power of the span, the points of contacts on their surfaces with the
  /// second. False where a contact point would leave its surface.
  bool at(double u, State& out);

 private:
  const JointModel& model_;
  const State& from_;
  const Correction& start_;
  double span_;
  Correction way_, end_, here_;  ///< from `from` to `to`; the tangent at `to` as a change of `way_`; at u
};

}  // namespace genu
