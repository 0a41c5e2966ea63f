// Whether a path that its follower cannot continue turns back there (a limit point), and where.
#pragma once

#include <optional>
#include <string>

#include "genu/path/path_follower.h"

namespace genu {

struct PathTurn {
  std::optional<PathEvent> event;  ///< `turns_back`, where it does
  std::string why;                 ///< of the end; empty where nothing is known beyond PathFollower::failure()
  int iterations = 0;
};

/// After advance_to() of `follower` on `plan` has failed; `step` is the event's.
PathTurn find_turn(ActiveSetSolver& solver, const PathOptions& options, PathFollower& follower, const StepPlan& plan,
                   int step);

}  // namespace genu
