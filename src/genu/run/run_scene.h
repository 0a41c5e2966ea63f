// The main job: a scene file in, a folder of results out.
#pragma once

#include <functional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/results/pose_table.h"
#include "genu/results/summary.h"
#include "genu/run/prepare.h"

namespace genu {

enum ExitCode : int { kExitOk = 0, kExitFailed = 1, kExitRefused = 2, kExitIncomplete = 3 };

struct Solution {
  std::vector<PoseRecord> records;
  std::vector<PathEvent> events;
  ResultTable poses, event_rows;
  RunSummary summary;
  std::string folder;  ///< where the results were written
};

struct RunOptions {
  PathOptions path;
  std::function<void(int done, int asked)> progress;  ///< called after every row; may be empty
  std::function<bool()> cancelled;                    ///< may be empty
};

/// Refuses what cannot be started (surfaces that overlap by more than 5 mm in the reference pose): said in `out`.
bool check_start(const Prepared& prepared, ContactField& field, Diagnostics& out);

/// Solves all steps. What could not be solved is in the statuses and in the verdict, never an error.
Solution solve(const Prepared& prepared, ContactField& field, const RunOptions& options);

/// Reads, solves, writes `folder`/results.csv, events.csv, curves.svg and summary.json. Returns the exit code; `out`
/// holds what was refused, `solution` (may be null) gets what was found.
int run_scene(const std::string& path, const std::string& folder, const RunOptions& options, Diagnostics& out,
              Solution* solution);

}  // namespace genu
