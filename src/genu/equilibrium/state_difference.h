// Differences between two states of one joint: distance and events.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/equilibrium/path_event.h"
#include "genu/equilibrium/pose_point.h"

namespace genu {

/// Characteristic lengths plus rad, summed over the bodies. Of many bodies (kManyBodies) the largest motion of any in
/// its parent: at the end of a chain a body moves far where each joint hardly moves. It does not bound the motion of
/// bodies that a ligament, contact or bushing connects across several joints.
double distance(const JointModel& model, const State& a, const State& b);

/// The same of the bodies' motion `twist` (6B) at a state, per unit of t.
double speed(const JointModel& model, const State& state, const VecX& twist);

/// Largest translation (m) and rotation (rad) of any body.
std::pair<double, double> largest_motion(const State& from, const State& to);

/// Contacts gained and lost ("medial.2"), and ligaments that passed sharp breaks: the events for an observer.
std::vector<std::pair<PathEvent::Kind, std::string>> changes(const JointModel& model, const State& before,
                                                             const State& after);

}  // namespace genu
