// What a run is asked for, and everything that it finds.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/cancelled.h"
#include "genu/motion/motion.h"
#include "genu/path/path_options.h"
#include "genu/path/starts.h"
#include "genu/path/tolerances.h"
#include "genu/results/error_bars.h"
#include "genu/results/pose_table.h"
#include "genu/results/starts_table.h"
#include "genu/results/summary.h"

namespace genu {

class Checkpoint;

/// kExitDoubtful: solved, with jumps or doubts (RunSummary::Class).
enum ExitCode : int { kExitOk = 0, kExitFailed = 1, kExitRefused = 2, kExitIncomplete = 3, kExitDoubtful = 4 };

/// Whether every pose is solved.
inline bool all_solved(int exit_code) { return exit_code == kExitOk || exit_code == kExitDoubtful; }

/// What following a scene's steps has found, before anything is said of it (study/solve_path.h).
struct Solved {
  std::vector<PoseRecord> records;
  std::vector<PathEvent> events;
  PathResult path;
  int asked = 0;                            ///< poses
  std::vector<RunSummary::Effect> effects;  ///< with what was counted on the way
  double seconds = 0;                       ///< that it took, without what rows report beyond their poses
  std::string stopped;  ///< what ended the work before its end: "interrupted", "out of memory", ...; else empty
  std::string rest;     ///< with RunOptions::keep_rest: where the path rested last with every row ok,
                        ///< after `rest_rows` rows
  std::size_t rest_rows = 0;

  int solved() const;  ///< poses
  bool complete() const { return path.complete && solved() == asked; }
};

/// The same with its tables and what it is worth.
struct Solution : Solved {
  std::vector<MotionPoint> motion;  ///< of a motion, in the place of records
  ResultTable poses, event_rows;
  std::optional<ResultTable> starts;    ///< where several starts were asked for
  std::optional<ErrorBars> error_bars;  ///< where they were asked for and the scene has meshes
  std::vector<std::string> prescribed;  ///< columns of `poses` that a step prescribes, in the order they come
  RunSummary summary;
  std::string folder;                       ///< where the results were written
  std::vector<std::string> pressure_files;  ///< in it, where they were asked for
};

struct RunOptions {
  PathOptions path;
  bool pressure_maps = false;  ///< writes what each triangle of each elastic layer carries at every pose as well
  bool report = false;         ///< writes report.html as well
  std::string beside;          ///< a table whose curves the report shows beside the computed ones; empty: none
  std::string beside_columns;  ///< which of its columns is which of results.csv (store/report_beside.h)
  bool error_bars = false;     ///< solves the scene on other surfaces its meshes might have given as well
  int starts = 0;  ///< > 0: searches from this many starts at the first pose as well; the path is the same without
  /// rad: how far the starts turn what is free; translations go half the characteristic length for each 20 deg of it
  double spread = kStartSpread;
  std::function<void(int done, int asked)> progress;  ///< called after every row; may be empty
  /// The same while error bars are sought, for the rows of all variants together: one call at a time, from any thread.
  std::function<void(int done, int asked)> varied_progress;
  Cancelled cancelled;
  bool resume = false;            ///< goes on from what an earlier run into the same folder has left
  double checkpoint_seconds = 1;  ///< from one part of a checkpoint (checkpoint.h) to the next
  std::string save_failure;       ///< a file for what reproduces a failure (failure.h); empty: none
  /// For solve(): where the path is written down as it goes, and what it goes on from; null where it is not.
  Checkpoint* checkpoint = nullptr;
  bool keep_partial = false;  ///< for solve(): where memory ends, what was found before is an answer; else it throws
  bool keep_rest = false;     ///< for solve(): Solution::rest is wanted
  std::string from;           ///< for solve(): a Solution::rest to begin with, in the place of the reference pose
};

}  // namespace genu
