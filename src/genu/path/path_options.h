// Input and output of path following.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "genu/equilibrium/path_event.h"
#include "genu/equilibrium/pose_point.h"

namespace genu {

struct PathOptions {
  NewtonOptions newton;
  double event_tolerance = 1e-9;     ///< of a step's parameter: accuracy of the position of events
  double smallest_increment = 1e-8;  ///< of a step's parameter: below this the path is stuck
  double largest_window = 0.0087;    ///< rad (0.5 deg): a longer gap without solution is not stepped over
  /// Whether breaks that ligaments' laws pass between two poses are located and reported (law_events.h). The path is
  /// the same without.
  bool locate_law_breaks = true;
};

struct PathResult {
  bool complete = false;  ///< every requested pose was solved
  int substeps = 0;
  int iterations = 0;
  double worst_residual = 0;
  /// Where no first pose is found under all loads: the part of them that is borne (raised_loads.h); else 0.
  double borne_loads = 0;
};

struct PathObserver {
  /// `layers`: memory of the elastic layers at this pose, valid during the call; null where there are none.
  std::function<void(const PosePoint&, LayerMemories* layers)> pose;
  std::function<void(const PathEvent&)> event;
  Cancelled cancelled;
  /// Called between rows from which a run can continue, about every 16; may be empty. `save()` returns what
  /// follow_path() needs to continue: bytes for the same program and the same input only. Rows and events already
  /// handed over are not included.
  std::function<void(const std::function<std::string()>& save)> rest;
};

/// Thrown by follow_path() where the saved bytes belong to another scene.
struct SavedElsewhere : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace genu
