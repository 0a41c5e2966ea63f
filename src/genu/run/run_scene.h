// The main job: a scene file in, a folder of results out.
#pragma once

#include <functional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/results/error_bars.h"
#include "genu/results/pose_table.h"
#include "genu/results/starts_table.h"
#include "genu/results/summary.h"
#include "genu/run/prepare.h"
#include "genu/solver/motion.h"

namespace genu {

class Checkpoint;

enum ExitCode : int { kExitOk = 0, kExitFailed = 1, kExitRefused = 2, kExitIncomplete = 3 };

struct Solution {
  std::vector<PoseRecord> records;
  std::vector<MotionPoint> motion;  ///< of a motion, in the place of records
  std::vector<PathEvent> events;
  ResultTable poses, event_rows;
  std::optional<ResultTable> starts;    ///< where several starts were asked for
  std::optional<ErrorBars> error_bars;  ///< where they were asked for and the scene has meshes
  std::vector<std::string> prescribed;  ///< columns of `poses` that a step prescribes, in the order they come
  RunSummary summary;
  std::string folder;   ///< where the results were written
  std::string stopped;  ///< what ended the work before its end: "interrupted", "out of memory", ...; else empty
  std::string rest;     ///< with RunOptions::keep_rest: where the path rested last with every row ok,
                        ///< after `rest_rows` rows
  std::size_t rest_rows = 0;
  std::vector<std::string> pressure_files;  ///< in it, where they were asked for
};

struct RunOptions {
  PathOptions path;
  bool pressure_maps = false;  ///< writes what each triangle of each elastic layer carries at every pose as well
  bool report = false;         ///< writes report.html as well
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
  Safeguards safeguards;      ///< all of them, but in tests of what each is good for
};

/// Reads and builds what a run into `folder` needs. Empty, with the reasons in `out`, where the input is refused or the
/// folder cannot be written or holds the input; without a `folder` nothing is to be written. `inputs`: other files that
/// the folder must not hold.
std::optional<Prepared> prepare_run(const std::string& path, const std::optional<std::string>& folder, Diagnostics& out,
                                    const std::vector<std::string>& inputs = {}, const Safeguards& safeguards = {});

/// Refuses what cannot be started (surfaces that overlap by more than 6 mm in the reference pose): said in `out`.
bool check_start(const Prepared& prepared, ContactField& field, Diagnostics& out);

/// `options.path`, solved as exactly as the scene asks for: the tolerance of `options` stands for nothing.
PathOptions path_options(const Scene& scene, const RunOptions& options);

/// Solves all steps. What could not be solved is in the statuses and in the verdict, never an error.
Solution solve(const Prepared& prepared, ContactField& field, const RunOptions& options);

/// The equilibria at the first pose of the first step that can be found from options.starts starts round the solution's
/// own first pose, or round the reference pose where that was not solved.
ResultTable find_equilibria(const Prepared& prepared, ContactField& field, const RunOptions& options,
                            const Solution& solution);

/// The error bars of a solution: the same path on every variant of the surfaces (surface_variants.h), side by side on
/// all threads. What a variant does not solve is said in the summary.
ErrorBars find_error_bars(const Prepared& prepared, const RunOptions& options, Solution& solution);

/// Names the files that a scene was read from, with their checksums, in its summary.
void note_files(const Scene& scene, RunSummary& summary);

/// Where the results go: into `folder`, or beside it where the run was cancelled and would replace a whole result by a
/// part of one. The verdict then says so.
std::string folder_for(const std::string& folder, const RunOptions& options, RunSummary& summary);

/// Everything that a run computes of a scene without motion, and with; empty where it is refused in `out`.
std::optional<Solution> solve_all(const Prepared& prepared, const RunOptions& options, Diagnostics& out);
std::optional<Solution> move_all(const Prepared& prepared, const RunOptions& options, Diagnostics& out);

/// Ends work that was stopped before its end: says so, with what is kept and how to go on, and puts `folder`'s partial
/// results beside it. Empty `checkpoint`: there is none.
void mark_partial(const std::string& scene, const std::string& folder, const Checkpoint* checkpoint, Solution& found);

/// Writes a solution's results.csv, events.csv, curves.svg, summary.json and, where they were asked for, starts.csv,
/// error_bars.csv and error_shares.csv into `folder`, and `more` beside them (name, content). `mark` stands before the
/// endings of the tables: ".partial". Returns what went wrong, else an empty text.
std::string write_results(const std::string& folder, const Prepared& prepared, const Solution& solution,
                          const std::vector<std::pair<std::string, std::string>>& more = {},
                          const std::string& mark = {});

/// Reads, solves, writes the results into `folder`. Returns the exit code; `out` holds what was refused, `solution`
/// (may be null) gets what was found.
int run_scene(const std::string& path, const std::string& folder, const RunOptions& options, Diagnostics& out,
              Solution* solution);

}  // namespace genu
