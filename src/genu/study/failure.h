// What is needed to see a failure again, in one text file: a failed run of a scene becomes FILE, FILE becomes a scene
// that fails in the same way.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/assemble/solution.h"
#include "genu/store/failure_file.h"

namespace genu {

/// Whether two lists of lines of Failure::verdict say the same.
bool alike(std::vector<std::string> expected, std::vector<std::string> found);

/// Writes `file` after a run of `scene` that was refused (`prepared` may then be null) or `found` not every pose to be
/// ok. Errors and warnings of that run stand in `out`, which gets a warning that says what was written, or why not.
void save_failure(const std::string& file, const std::string& scene, const Prepared* prepared, const Solution& found,
                  const RunOptions& options, Diagnostics& out);

/// Writes scene.toml and the meshes into `folder`. An error as text; the empty text is success.
[[nodiscard]] std::string unpack(const Failure& failure, const std::string& folder);

/// Runs what was unpacked into `folder`, and gives the lines that Failure::verdict would have.
std::vector<std::string> reproduce(const Failure& failure, const std::string& folder, const RunOptions& options);

}  // namespace genu
