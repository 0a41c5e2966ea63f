// genu sensitivity knee.toml --of knee.adduction --to "*.stiffness" --out out/knee
//   1. read scene and meshes; refuse with every error at once, unknown names among them
//   2. solve pose after pose, and differentiate each
//   3. print what matters most; write the run's results, sensitivity.csv, ranking.csv, sensitivity.svg
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
#include "genu/study/sensitivity.h"

namespace genu::cli {
namespace {

constexpr int kMostPrinted = 1'000'000;

struct SensitivityArguments {
  SceneChanges changes;
  std::string scene;
  std::optional<std::string> folder;
  SensitivityChoice choice;
};

int differentiate(const SensitivityArguments& arguments) {
  Diagnostics diagnostics;
  SensitivityResult result;
  RunOptions options;
  options.cancelled = stop_on_interrupt();
  const int code = run_sensitivity({arguments.scene, arguments.changes}, arguments.folder, arguments.choice, options,
                                   diagnostics, result);
  print(diagnostics, code == kExitFailed);
  if (code == kExitRefused) return code;
  fmt::print("{}\n\n{}", printable(result.solution.summary.title), result.text);
  for (const std::string& sentence : result.solution.summary.verdict)
    fmt::print("  {:<12}{}\n", "verdict", printable(sentence));
  if (code != kExitFailed && arguments.folder)
    fmt::print("  {:<12}{}/sensitivity.csv, ranking.csv, sensitivity.svg, and the run's own results\n", "written",
               result.solution.folder);
  return code;
}

}  // namespace

void add_sensitivity(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<SensitivityArguments>();
  command.add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
  command
      .add_option("--of", arguments->choice.outputs,
                  "outputs: columns of results.csv, with or without the unit; * and ? stand for letters, or \"all\"")
      ->required()
      ->delimiter(',');
  command
      .add_option("--to", arguments->choice.parameters,
                  "parameters by their keys: AAC.stiffness, AAC.from.x, condyle.radii.z, plate.terms.2.0, "
                  "femur.offset, push.force.z, knee.flexion; * and ? stand for letters, or \"all\"")
      ->required()
      ->delimiter(',');
  command.add_option("-o,--out", arguments->folder, "folder for the results, replaced as a whole at the end");
  command.add_option("--top", arguments->choice.most, "how many parameters to print for each output")
      ->check(CLI::Range(1, kMostPrinted))
      ->capture_default_str();
  add_changes(command, arguments->changes);
  command.footer(
      "Example: genu sensitivity knee.toml --of knee.adduction medial.force --to \"*.stiffness\" \"*.from.*\" --out "
      "out/knee");
  advice().hint("sensitivity",
                "the verdict above says where the path ends; shorten the motion to the rows that are ok");
  command.callback([arguments, &exit_code] { exit_code = differentiate(*arguments); });
}

}  // namespace genu::cli
