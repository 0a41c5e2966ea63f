// How lax a knee is: at each flexion angle the neutral pose, then each load up, down and back through zero, with all
// coordinates but flexion free. Steps over the solver of runs: no mechanics of its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/study/laxity_result.h"

namespace genu {

/// Tests one scene that is prepared, as it is. The exit code: refused, with the reasons in `out`, or as of
/// run_laxity(); ok also where there are doubts, which the verdict says.
[[nodiscard]] int test_laxity(const Prepared& prepared, const LaxityChoice& choice, Diagnostics& out,
                              LaxityResult& result);

/// Reads the scene, with its changes the scene as written as well, and tests both. Writes laxity.csv,
/// laxity_summary.csv, laxity.html, one picture a test and summary.json into `folder` where there is one, or beside it
/// (folder_for()) where it was cancelled. The exit code: incomplete where a leg or a neutral pose is missing,
/// doubtful where one is unstable or a run of the same poses would be doubted.
[[nodiscard]] int run_laxity(const SceneSource& source, const std::optional<std::string>& folder,
                             const LaxityChoice& choice, Diagnostics& out, LaxityResult& result);

}  // namespace genu
