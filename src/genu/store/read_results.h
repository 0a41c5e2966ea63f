// A finished run as read from its folder: what was solved, for those who show it in another way. No second
// reader of results: the poses come through pose_file and pose_columns, as those of `genu evaluate` do.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/assemble/solution.h"

namespace genu {

struct ResultsRead {
  Prepared prepared;
  /// Records with poses, coordinates, load factors, time and rigid contacts (their forces, and directions from the
  /// surfaces); poses: the cells of results.csv. One for each row that holds a pose.
  Solution solution;
  std::vector<std::size_t> numbers;  ///< of these rows in results.csv, from 1
  std::size_t left_out = 0;          ///< rows without a pose
};

/// `scene`: path of the scene file; `text`: of results.csv, the content of `file`. What is wrong with either is said
/// in `out`. A contact whose place is not on its surface, as where the scene was changed, is left out with a warning.
[[nodiscard]] std::optional<ResultsRead> read_results(const SceneSource& scene, const std::string& text,
                                                      const std::string& file, Diagnostics& out);

}  // namespace genu
