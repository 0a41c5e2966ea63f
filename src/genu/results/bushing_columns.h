// Columns of bushings: displacement, and force and moment on the second body.
#pragma once

#include "genu/model/joint_model.h"
#include "genu/model/state.h"
#include "genu/results/result_table.h"

namespace genu {

/// For each bushing NAME.x_mm ... NAME.turn_z_deg, the displacement of its second frame from the first and the rotation
/// vector, in the axes of the first; and NAME.force_x_N ... NAME.moment_z_Nm, what it does to the second body at the
/// origin of its frame, in the same axes. Without dampers.
void add_bushing_columns(const JointModel& model, ResultTable& table);
void set_bushing_columns(const JointModel& model, const State& state, ResultTable& table);

}  // namespace genu
