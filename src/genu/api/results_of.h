// What the rooms below have found as results of the API. Not installed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "genu/api/inside.h"
#include "genu/api/results.h"
#include "genu/assemble/solution.h"

namespace genu::api {

/// Of a run, with what a report needs.
Results results_of(std::shared_ptr<Ready> ready, Solution solution, std::vector<std::string> changes);
/// Of poses that were given.
Results results_of(std::shared_ptr<Ready> ready, std::vector<PoseRecord> records, ResultTable poses, RunSummary summary,
                   std::vector<std::string> changes);

}  // namespace genu::api
