// Moment arms of ligaments and cables, where a scene asks for them (`moment_arms`).
#pragma once

#include <string>

#include "genu/model/joint_model.h"
#include "genu/model/state.h"
#include "genu/results/result_table.h"
#include "genu/scene/scene.h"

namespace genu {

/// `path`: the name of a ligament or load.
std::string moment_arm_column(const PlacedScene& scene, const std::string& path, const CoordinateRef& c);

void add_moment_arm_columns(const PlacedScene& scene, const JointModel& model, ResultTable& table);

/// Positive where a pull drives the coordinate up. Empty where a joint is at its gimbal pose.
void set_moment_arm_columns(const PlacedScene& scene, const JointModel& model, const State& state, ResultTable& table);

}  // namespace genu
