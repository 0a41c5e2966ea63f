// Two states of one joint beside each other: how far apart they are, and what has changed on the way.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/equilibrium/path_event.h"
#include "genu/equilibrium/pose_point.h"

namespace genu {

/// Characteristic lengths plus rad, summed over the bodies.
double distance(const JointModel& model, const State& a, const State& b);

/// Of the body that moves most in each: m and rad.
std::pair<double, double> largest_motion(const State& from, const State& to);

/// Contacts gained and lost ("medial.2") and what has become of ligaments at sharp breaks: what an observer is told.
std::vector<std::pair<PathEvent::Kind, std::string>> changes(const JointModel& model, const State& before,
                                                             const State& after);

}  // namespace genu
