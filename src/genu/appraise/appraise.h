// What a solved path is worth: counts, certificate, doubts, and the sentences of the verdict.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/assemble/solution.h"
#include "genu/equilibrium/newton.h"
#include "genu/model/contact_field.h"

namespace genu {

/// `poses`: the pose_table() of what was solved.
RunSummary appraise(const Prepared& prepared, const Solved& solved, const ResultTable& poses);

/// What common sense holds against a solved path, as sentences without a full stop: jumps (jumps.h), poses where the
/// joint would not stay (unstable.h), numbers beyond the scene's limits (implausible.h).
std::vector<std::string> doubts_of(const Prepared& prepared, const Solved& solved, const ResultTable& poses);

/// Sets the class of a verdict and, where all is solved and `doubts` or what else is `doubted` remain, the exit code.
/// The doubts become sentences: of a solved run they come first.
void classify(const std::vector<std::string>& doubts, bool doubted, RunSummary& summary);

}  // namespace genu
