// How outputs of a scene follow its parameters along the path: names to columns and numbers, a run, its derivatives.
#pragma once

#include <string>
#include <vector>

#include "genu/results/sensitivity_table.h"
#include "genu/study/run_scene.h"

namespace genu {

/// Outputs and parameters chosen by name: columns of results.csv, with or without the unit at their end
/// ("knee.adduction"), and Parameter::name. * and ? stand for letters, "all" for everything there is. Parameters named
/// by patterns joined by + with ":together" at the end ("MCLs*.stiffness+MCLd*.stiffness:together") are one that moves
/// all of them at once.
struct SensitivityChoice {
  std::vector<std::string> outputs, parameters;
  std::size_t most = 10;  ///< parameters of each output that the text of the result lists
};

struct SensitivityResult {
  Solution solution;
  SensitivityRows rows;
  int poses_without = 0;  ///< not solved, or not determined: no derivative exists there
  double seconds = 0;     ///< of the derivatives alone
  std::string text;       ///< the ranking for a terminal, and what could not be differentiated
};

/// The outputs and parameters that a choice names, in the scene's order, without derivatives. Names that are none, and
/// columns that have no derivative, are said in `out`, all of them. How many contacts a pair has is not known before
/// the run: `contact_numbers` of each are listed.
SensitivityRows choose(const Prepared& prepared, const SensitivityChoice& choice, int contact_numbers,
                       Diagnostics& out);

/// Derivatives of what is chosen at every record of `result.solution`, of all contacts that it has.
void differentiate(const Prepared& prepared, ContactField& field, const SensitivityChoice& choice,
                   SensitivityResult& result);

/// Solves a scene and differentiates what is chosen. False, with the reasons in `out`, where that is refused.
[[nodiscard]] bool solve_and_differentiate(const Prepared& prepared, const SensitivityChoice& choice,
                                           const RunOptions& options, Diagnostics& out, SensitivityResult& result);

/// Reads, solves and differentiates a scene, and writes the run's results with sensitivity.csv, ranking.csv and
/// sensitivity.svg into `folder` where there is one. Returns the exit code.
[[nodiscard]] int run_sensitivity(const SceneSource& source, const std::optional<std::string>& folder,
                                  const SensitivityChoice& choice, const RunOptions& options, Diagnostics& out,
                                  SensitivityResult& result);

}  // namespace genu
