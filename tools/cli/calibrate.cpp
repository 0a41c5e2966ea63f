// genu calibrate knee.toml --target measured.csv --vary "j1.stiffness,j1.damping" --out out/fitted
//   1. read scene, meshes and target; refuse with every error at once, unknown names among them
//   2. fit the named numbers of the scene so that its results follow the target
//   3. print them with their uncertainty; write the fitted scene, its results, calibration.csv and comparison.csv
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "changes.h"
#include "commands.h"
#include "genu/calibrate/calibrate.h"

namespace genu::cli {
namespace {

constexpr int kMostIterations = 10'000, kMostStarts = 1000;
constexpr double kMostSpread = 100, kMostLoad = 1e5;

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
  const bool fitted = !result.report.parameters.empty();
  if (code == kExitRefused || (!fitted && result.text.empty())) return code;
  if (!fitted)
    advice().hint("calibrate", "nothing was fitted: the verdict says what the scene with the written numbers does");
  fmt::print("{}\n\n{}{}", printable(result.solution.summary.title), fitted ? to_text(result.report) : "", result.text);
  if (!fitted)
    for (const std::string& line : result.solution.summary.verdict)
      fmt::print("  {:<12}{}\n", &line == &result.solution.summary.verdict.front() ? "verdict" : "", printable(line));
  if (code != kExitFailed && arguments.folder)
    fmt::print(
        "  {:<12}{}/scene.toml, {}and the scene's results\n", "written", result.solution.folder,
        fitted ? "calibration.csv, comparison.csv, starts.csv, standard_errors.csv, study.toml, pictures, " : "");
  return code;
}

}  // namespace

void add_calibrate(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<CalibrateArguments>();
  command.add_option("SCENE", arguments->scene, "scene file (TOML): its numbers are the start")->required();
  CalibrationChoice& choice = arguments->choice;
  const auto list = [&](const char* name, std::vector<std::string>& values, const char* help) {
    return command.add_option(name, values, help)->delimiter(',');
  };
  list("--target", choice.targets,
       "CSV file with a column time_s, or a prescribed coordinate, and columns named as in results.csv; or a laxity "
       "table (flexion_deg, test, load_N, load_Nm, displacement_mm, displacement_deg); SCENE=FILE for another scene "
       "with the same parameters");
  list("--vary", choice.vary,
       "parameters by their keys, as of genu sensitivity: j1.stiffness, AAC.slack_length, push.force.z; * and ? stand "
       "for letters; \"ACL*.slack_length:together\" is one factor (:factor) or shift (:offset) of all, "
       "\"*.slack_length:bundles\" one for each bundle")
      ->required();
  list("--columns", choice.columns, "columns of the target to follow; all, or displacements, where none is named");
  list("--error", choice.errors, "COLUMN=SIGMA: errors of measurement, in the unit of the column: displacement_mm=0.3");
  list("--bounds", choice.bounds, "NAME=LOW..HIGH: of a number that is varied");
  list("--prior", choice.priors, "NAME=MEAN~SD: what is known before; MEAN may be start, SD a share: start~5%");
  list("--predict", choice.held_out, "targets that are not fitted but predicted, with standard errors");
  list("--predict-columns", choice.predict_columns, "columns of these, in the place of --columns");
  list(
      "--zero-load", choice.zero_load.poses,
      "tables of passive poses, as of genu evaluate: each slack length starts at the fibre's longest length over them; "
      "without --target it stays there");
  list("--correction", choice.zero_load.correction, "times this factor: 0.95, or \"ACL*=0.95\" for some ligaments");
  list("--design", choice.candidates,
       "laxity tables, whose curves could be measured: ranks them by how much each would narrow standard errors");
  list("--narrow", choice.narrow, "the numbers that --design is about; all where none is named");
  command.add_option("--starts", choice.starts, "starts of the fit: the scene's numbers, and others around them")
      ->check(CLI::Range(1, kMostStarts))
      ->capture_default_str();
  command
      .add_option("--spread", choice.spread, "how far the other starts go, in standard changes (1 %, 0.01 of strain)")
      ->check(number_within(1e-6, kMostSpread))
      ->capture_default_str();
  command.add_option("--compression", choice.compression, "force in N along the tibia's axis, of laxity tests")
      ->check(number_within(0, kMostLoad))
      ->capture_default_str();
  command.add_option("--most-iterations", arguments->choice.most_iterations, "stop after so many")
      ->check(CLI::Range(1, kMostIterations))
      ->capture_default_str();
  command.add_option("-o,--out", arguments->folder, "folder for the fitted scene and its results");
  add_changes(command, arguments->changes);
  command.footer(
      "Exit code 0: fitted; 3: not converged, a ligament is slack in every pose, or the target does not determine a "
      "number; 2: refused."
      "\nExample: genu calibrate knee.toml --target measured.csv --vary j1.stiffness j1.damping --out out/fitted");
  advice().hint("calibrate", "look at comparison.csv for where the fit is poor; vary fewer parameters, or others");
  command.callback([arguments, &exit_code] { exit_code = calibrate(*arguments); });
}

}  // namespace genu::cli
