// What forces and contacts a scene has at poses that are given: nothing is solved.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "genu/assemble/given_poses.h"
#include "genu/study/run_scene.h"

namespace genu {

struct EvaluateOptions {
  PoseColumnOptions columns;
  bool pressure_maps = false;  ///< as RunOptions::pressure_maps
  Cancelled cancelled;
};

struct Evaluation {
  std::vector<PoseRecord> records;
  ResultTable poses;  ///< the columns of a run's results.csv, then what each moving body lacks to balance
  RunSummary summary;
  std::string folder;                       ///< where the results were written
  std::vector<std::string> pressure_files;  ///< in it, where they were asked for
};

/// Evaluates a scene at every pose, as far as it is not cancelled. Forces of rigid contacts follow from an equilibrium
/// alone and stay empty; reactions of what is prescribed and of what joints hold are what the pose would need, where
/// the scene has no rigid contacts.
Evaluation evaluate(const Prepared& prepared, ContactField& field, const GivenPoses& given,
                    const EvaluateOptions& options);

/// Evaluates a scene at every pose of `file`, and says what that is worth. Empty, with the reasons in `out`, where its
/// columns or cells are refused.
[[nodiscard]] std::optional<Evaluation> evaluate_file(const Prepared& prepared, PoseFile file,
                                                      const EvaluateOptions& options, Diagnostics& out);

/// Reads the scene and the poses, evaluates, writes results.csv, curves.svg and summary.json into `folder`. Returns the
/// exit code; `out` holds what was refused, `evaluation` (may be null) gets what was found.
[[nodiscard]] int evaluate_scene(const SceneSource& source, const std::string& poses, const std::string& folder,
                                 const EvaluateOptions& options, Diagnostics& out, Evaluation* evaluation);

}  // namespace genu
