// Several studies in one page: the same numbers of, say, an intact knee and one without a ligament.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/sweep/sweep_table.h"

namespace genu {

/// A study with the name it gets beside others.
using NamedSweep = std::pair<std::string, SweepTable>;

/// All cases of all studies as cases of one, whose kept numbers are those that every study keeps. Scenes are paired in
/// their order, under the names of the first study's; factors are left out: ranks belong to each study's own page.
/// Where all factors that two studies share have the same draws, samples are the same knees, and the first study is
/// what the others are subtracted from. Empty, with the reasons in `out`: no number in common, other counts of samples
/// or scenes.
struct JoinedSweeps {
  SweepTable table;
  std::vector<std::string> paired;  ///< studies whose samples are those of the first one
};
[[nodiscard]] std::optional<JoinedSweeps> join_sweeps(const std::vector<NamedSweep>& sweeps, Diagnostics& out);

/// Whether any of these folders holds a study.
bool has_sweep(const std::vector<std::string>& folders);

/// Writes one page (HTML) on the merged studies in these folders. Returns the exit code; what cannot be compared is
/// named in `out`.
[[nodiscard]] int compare_sweeps(const std::vector<std::string>& folders, const std::string& file, Diagnostics& out);

}  // namespace genu
