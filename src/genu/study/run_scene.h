// The main job: a scene file in, a folder of results out.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/assemble/solution.h"
#include "genu/core/diagnostics.h"

namespace genu {

/// Reads and builds what a run into `folder` needs. Empty, with the reasons in `out`, where the input is refused or the
/// folder cannot be written or holds the input; without a `folder` nothing is to be written. `inputs`: other files that
/// the folder must not hold.
[[nodiscard]] std::optional<Prepared> prepare_run(const SceneSource& source, const std::optional<std::string>& folder,
                                                  Diagnostics& out, const std::vector<std::string>& inputs = {});

/// Refuses what cannot be started (surfaces that overlap by more than 6 mm in the reference pose): said in `out`.
[[nodiscard]] bool check_start(const Prepared& prepared, ContactField& field, Diagnostics& out);

/// solve_path(), its tables, and what it is worth (appraise()). What could not be solved is in the statuses and in the
/// verdict, never an error.
Solution solve(const Prepared& prepared, ContactField& field, const RunOptions& options);

/// The equilibria at the first pose of the first step that can be found from options.starts starts round the solution's
/// own first pose, or round the reference pose where that was not solved.
ResultTable find_equilibria(const Prepared& prepared, ContactField& field, const RunOptions& options,
                            const Solution& solution);

/// The error bars of a solution: the same path on every variant of the surfaces (surface_variants.h), side by side on
/// all threads. What a variant does not solve is said in the summary.
ErrorBars find_error_bars(const Prepared& prepared, const RunOptions& options, Solution& solution);

/// Names the files that a scene was read from, with the checksums of what was read, in its summary.
void note_files(const Prepared& prepared, RunSummary& summary);

/// Where the results go: into `folder`, or beside it where the run was cancelled and would replace a whole result by a
/// part of one. The verdict then says so.
std::string folder_for(const std::string& folder, const RunOptions& options, RunSummary& summary);

/// Everything that a run computes of a scene without motion, and with; empty where it is refused in `out`.
[[nodiscard]] std::optional<Solution> solve_all(const Prepared& prepared, const RunOptions& options, Diagnostics& out);
[[nodiscard]] std::optional<Solution> move_all(const Prepared& prepared, const RunOptions& options, Diagnostics& out);

/// Ends work that was stopped before its end: says so, with what is kept and how to go on, and puts `folder`'s partial
/// results beside it. Empty `checkpoint`: there is none.
void mark_partial(const std::string& scene, const std::string& folder, const Checkpoint* checkpoint, Solution& found);

/// Writes a solution's results.csv, events.csv, curves.svg, summary.json and, where they were asked for, starts.csv,
/// error_bars.csv and error_shares.csv into `folder`, and `more` beside them (name, content). `mark` stands before the
/// endings of the tables: ".partial". Returns what went wrong, else an empty text.
[[nodiscard]] std::string write_results(const std::string& folder, const Prepared& prepared, const Solution& solution,
                                        const std::vector<std::pair<std::string, std::string>>& more = {},
                                        const std::string& mark = {});

/// Reads, solves, writes the results into `folder`. Returns the exit code; `out` holds what was refused, `solution`
/// (may be null) gets what was found.
[[nodiscard]] int run_scene(const SceneSource& source, const std::string& folder, const RunOptions& options,
                            Diagnostics& out, Solution* solution);

}  // namespace genu
