// Columns of ligaments and cables that wrap round surfaces; none without them.
//
//   PATH.SURFACE.touches         1 where it touches, 0 where it is free
//   PATH.SURFACE.arc_mm          length along the surface
//   PATH.SURFACE.begin.x_mm ...  where it comes onto the surface, and .end.x_mm ... where it leaves, in the frame of
//   the
//                                surface's body; empty where it is free
//   CABLE.length_mm              length of a cable
// A surface named again on the same path is SURFACE.2, ...
#pragma once

#include "genu/model/state.h"
#include "genu/results/result_table.h"

namespace genu {

void add_wrap_columns(const JointModel& model, ResultTable& table);

/// Settles the paths of a state that results were read into.
void settle_shown_wraps(const JointModel& model, State& state);

/// Fills the last row.
void set_wrap_columns(const JointModel& model, const State& state, ResultTable& table);

}  // namespace genu
