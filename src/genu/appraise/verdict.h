// What a run found, in sentences: what was solved, what was not, where, why, and what the user can do.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"
#include "genu/results/summary.h"

namespace genu {

std::vector<std::string> verdict_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                           const std::vector<PathEvent>& events, const RunSummary& summary);

}  // namespace genu
