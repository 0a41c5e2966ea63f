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

namespace genu {

enum ExitCode : int { kExitOk = 0, kExitFailed = 1, kExitRefused = 2, kExitIncomplete = 3 };

struct Solution {
  std::vector<PoseRecord> records;
  std::vector<PathEvent> events;
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
  bool error_bars = false;     ///< solves the scene on other surfaces its meshes might have given as well
  int starts = 0;  ///< > 0: searches from this many starts at the first pose as well; the path is the same without
  /// rad: how far the starts turn what is free; translations go half the characteristic length for each 20 deg of it
  double spread = kStartSpread;
  std::function<void(int done, int asked)> progress;  ///< called after every row; may be empty
  /// The same while error bars are sought, for the rows of all variants together: one call at a time, from any thread.
  std::function<void(int done, int asked)> varied_progress;
  Cancelled cancelled;
};

/// Reads and builds what a run into `folder` needs. Empty, with the reasons in `out`, where the input is refused or the
/// folder cannot be written or holds the input; without a `folder` nothing is to be written. `inputs`: other files that
/// the folder must not hold.
std::optional<Prepared> prepare_run(const std::string& path, const std::optional<std::string>& folder, Diagnostics& out,
                                    const std::vector<std::string>& inputs = {});

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

/// Where the results go: into `folder`, or beside it where the run was cancelled and would replace a whole result by a
/// part of one. The verdict then says so.
std::string folder_for(const std::string& folder, const RunOptions& options, RunSummary& summary);

/// Writes a solution's results.csv, events.csv, curves.svg, summary.json and, where they were asked for, starts.csv,
/// error_bars.csv and error_shares.csv into `folder`, and `more` beside them (name, content). Returns what went wrong,
/// else an empty text.
std::string write_results(const std::string& folder, const Prepared& prepared, const Solution& solution,
                          const std::vector<std::pair<std::string, std::string>>& more = {});

/// Reads, solves, writes the results into `folder`. Returns the exit code; `out` holds what was refused, `solution`
/// (may be null) gets what was found.
int run_scene(const std::string& path, const std::string& folder, const RunOptions& options, Diagnostics& out,
              Solution* solution);

}  // namespace genu
