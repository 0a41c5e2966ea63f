// genu calibrate knee.toml --target measured.csv --vary "j1.stiffness,j1.damping" --out out/fitted
//   1. read scene, meshes and target; refuse with every error at once, unknown names among them
//   2. fit the named numbers of the scene so that its results follow the target
//   3. print them with their uncertainty; write the fitted scene, its results, calibration.csv and comparison.csv
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "changes.h"
#include "commands.h"
#include "genu/study/calibrate.h"

namespace genu::cli {
namespace {

constexpr int kMostIterations = 10'000;

struct CalibrateArguments {
  SceneChanges changes;
  std::string scene;
  std::optional<std::string> folder;
  CalibrationChoice choice;
};

int calibrate(const CalibrateArguments& arguments) {
  Diagnostics diagnostics;
  CalibrationResult result;
  RunOptions options;
  options.cancelled = stop_on_interrupt();
  const int code = run_calibration({arguments.scene, arguments.changes}, arguments.folder, arguments.choice, options,
                                   diagnostics, result);
  print(diagnostics, code != kExitRefused);
  if (code == kExitRefused || result.report.parameters.empty()) return code;
  fmt::print("{}\n\n{}", printable(result.solution.summary.title), to_text(result.report));
  if (code != kExitFailed && arguments.folder)
    fmt::print("  {:<12}{}/scene.toml, calibration.csv, comparison.csv, and the fitted scene's results\n", "written",
               result.solution.folder);
  return code;
}

}  // namespace

void add_calibrate(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<CalibrateArguments>();
  command.add_option("SCENE", arguments->scene, "scene file (TOML): its numbers are the start")->required();
  command
      .add_option("--target", arguments->choice.target,
                  "CSV file with a column time_s and columns named as in results.csv: what they should be")
      ->required();
  command
      .add_option("--vary", arguments->choice.vary,
                  "parameters by their keys, as of genu sensitivity: j1.stiffness, j1.damping, AAC.from.x, "
                  "push.force.z, tibia.mass; * and ? stand for letters")
      ->required()
      ->delimiter(',');
  command
      .add_option("--columns", arguments->choice.columns, "columns of the target to follow; all where none is named")
      ->delimiter(',');
  command.add_option("--most-iterations", arguments->choice.most_iterations, "stop after so many")
      ->check(CLI::Range(1, kMostIterations))
      ->capture_default_str();
  command.add_option("--out", arguments->folder, "folder for the fitted scene and its results");
  add_changes(command, arguments->changes);
  command.footer(
      "Exit code 0: fitted; 3: not converged, or the target does not determine a number; 2: refused."
      "\nExample: genu calibrate knee.toml --target measured.csv --vary j1.stiffness j1.damping --out out/fitted");
  advice().hint("calibrate", "look at comparison.csv for where the fit is poor; vary fewer parameters, or others");
  command.callback([arguments, &exit_code] { exit_code = calibrate(*arguments); });
}

}  // namespace genu::cli
