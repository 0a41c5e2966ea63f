// What came out of a hard case, held to what must.
#pragma once

#include <string>
#include <vector>

#include "genu/study/run_scene.h"
#include "hard_cases/hard_case.h"

namespace genu {

/// Everything that a run has said and computed.
struct CaseResult {
  int exit_code = 0;
  Diagnostics diagnostics;
  Solution solution;
};

/// All words of a run: refusals, warnings, verdict, events and why poses were not accepted.
std::string words_of(const CaseResult& result);

/// Iterations of Newton's method; of a motion: steps.
int work_of(const RunSummary& summary);

/// How the result differs from what is expected, a line each; empty where it does not.
std::vector<std::string> misses(const Expectation& expected, const CaseResult& result);

}  // namespace genu
