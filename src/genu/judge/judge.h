// The independent judge of results: recomputes the table of a run from the scene, and accepts or rejects each pose
// called ok. It shares no code with the solver. docs/judge.md lists checks and tolerances.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/judge/findings.h"
#include "genu/scene/scene.h"

namespace genu::judge {

struct Options {
  int samples = 120;      ///< along each side of a closed form, for overlap and pressure
  std::size_t every = 1;  ///< overlap and pressure are judged in every n-th row, and in the first and last
};

struct Judgement {
  Findings findings;
  std::size_t rows = 0, judged = 0;                         ///< in the table; of these called ok
  std::vector<std::pair<std::size_t, std::string>> not_ok;  ///< rows (from 0) with another status: not judged
  std::vector<std::string> not_judged;                      ///< checks left out, with reasons
  std::vector<std::size_t> jumps;                           ///< rows (from 0) that no path connects with those before

  std::size_t rejected() const;
  bool accepted() const { return rejected() == 0; }
};

/// Judges the text of a results.csv. `scene`: as the reader returns it. Empty, with the reasons in `out`, where columns
/// or rows are missing, or a mesh cannot be read.
[[nodiscard]] std::optional<Judgement> judge_results(const Scene& scene, const std::string& csv,
                                                     const std::string& csv_name, const Options& options,
                                                     Diagnostics& out);

/// A line for each check, the checks left out, and the verdict.
std::string to_text(const Judgement& judgement);
std::string to_json(const Judgement& judgement);
/// check, numbers, poses, worst, tolerance, unit, where, rejected
std::string to_csv(const Judgement& judgement);

}  // namespace genu::judge
