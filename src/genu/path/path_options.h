// What a path is asked for, what it hands over on the way, and what comes back.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "genu/equilibrium/path_event.h"
#include "genu/equilibrium/pose_point.h"

namespace genu {

struct PathOptions {
  NewtonOptions newton;
  double event_tolerance = 1e-9;     ///< of a step's parameter: how finely an event is located
  double smallest_increment = 1e-8;  ///< of a step's parameter: below this the path is stuck
  double largest_window = 0.0087;    ///< rad (0.5 deg): a stretch without solution longer than this is not stepped over
};

struct PathResult {
  bool complete = false;  ///< every pose asked for was solved
  int substeps = 0;
  int iterations = 0;
  double worst_residual = 0;
};

struct PathObserver {
  /// `layers`: what solving the pose has shown of its elastic layers, for the call alone; null where there are none.
  std::function<void(const PosePoint&, LayerMemories* layers)> pose;
  std::function<void(const PathEvent&)> event;
  Cancelled cancelled;
  /// Called between rows from which a walk can go on later, every 16 or so; may be empty. `save()` gives what it goes
  /// on from, which follow_path() takes: bytes for the same program on the same input, and for nothing else. Rows and
  /// events handed over before are not among them.
  std::function<void(const std::function<std::string()>& save)> rest;
};

/// What follow_path() throws where it is to go on from what another scene has saved.
struct SavedElsewhere : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace genu
