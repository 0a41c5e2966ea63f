// Differences between two states of one joint: distance and events.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/equilibrium/path_event.h"
#include "genu/equilibrium/pose_point.h"

namespace genu {

/// Characteristic lengths plus rad, summed over the bodies.
double distance(const JointModel& model, const State& a, const State& b);

/// Largest translation (m) and rotation (rad) of any body.
std::pair<double, double> largest_motion(const State& from, const State& to);

/// Contacts gained and lost ("medial.2"), and ligaments that passed sharp breaks: the events for an observer.
std::vector<std::pair<PathEvent::Kind, std::string>> changes(const JointModel& model, const State& before,
                                                             const State& after);

}  // namespace genu
