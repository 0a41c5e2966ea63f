// The catalogue of hard cases (tests/hard_cases), run side by side: each answered right, or the case is missed.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hard_cases/hard_case.h"

namespace genu {

struct HardCaseOptions {
  std::optional<std::string> folder;  ///< of the results, FAMILY/NAME each; empty: kept nowhere
  std::function<void(int done, int all)> progress;
};

struct HardCaseOutcome {
  const HardCase* hard_case = nullptr;
  std::vector<std::string> misses;
  int iterations = 0;  ///< of Newton's method; of a motion: steps
  double worst_residual = 0;
  double seconds = 0;
  bool met() const { return misses.empty(); }
};

/// Runs one case; `shapes_folder` has the shapes.toml that its meshes are cut from.
HardCaseOutcome run_hard_case(const HardCase& hard_case, const std::string& shapes_folder,
                              const HardCaseOptions& options);

/// The same for all, side by side; outcomes in the order of the cases, the same on any number of threads but for times.
std::vector<HardCaseOutcome> run_hard_cases(const std::vector<HardCase>& cases, const std::string& shapes_folder,
                                            const HardCaseOptions& options);

/// case, verdict, iterations, worst residual, time; below it what was missed.
std::string to_text(const std::vector<HardCaseOutcome>& outcomes);

/// What cases there are, family by family: docs/hard-cases.md.
std::string to_markdown(const std::vector<HardCase>& cases);

}  // namespace genu
