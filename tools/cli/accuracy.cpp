// genu accuracy knee.toml --target 0.01mm --target 0.05deg --out out/accuracy
//   1. read scene and meshes; refuse with every error at once
//   2. solve it under many settings, in rounds
//   3. print errors and times, and which setting to take; write accuracy.csv, accuracy.svg, and the scene with it
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/study/accuracy.h"
#include "progress.h"

namespace genu::cli {
namespace {

constexpr int kMostRounds = 1000;
constexpr double kMostSeconds = 1e6;

struct AccuracyArguments {
  std::string scene;
  std::optional<std::string> folder;
  AccuracyChoice choice;
};

int compare(const AccuracyArguments& arguments) {
  Diagnostics diagnostics;
  AccuracyReport report;
  Solution own;
  RunOptions options;
  options.cancelled = stop_on_interrupt();
  Progress progress;
  options.varied_progress = [&](int done, int asked) { progress(done, asked, "paths"); };
  const int code = run_accuracy(arguments.scene, arguments.folder, arguments.choice, options, diagnostics, report, own);
  progress.finish();
  print(diagnostics, code == kExitFailed);
  if (code == kExitRefused || report.points.empty()) return code;
  fmt::print("{}\n{}", printable(report.title), to_text(report));
  if (code != kExitFailed && arguments.folder)
    fmt::print("  {:<12}{}/accuracy.csv, accuracy.svg{}, report.html, and the scene's own results\n", "written",
               own.folder, report.targets.empty() || report.chosen < 0 ? "" : ", scene.toml");
  return code;
}

}  // namespace

void add_accuracy(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<AccuracyArguments>();
  command.add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
  command
      .add_option("--target", arguments->choice.targets,
                  "errors that are allowed: 0.01mm, 0.05deg, 1N; the fastest setting that keeps them is chosen, and "
                  "written to OUT/scene.toml")
      ->delimiter(',');
  command.add_option("--rounds", arguments->choice.rounds, "how often each setting is timed")
      ->check(CLI::Range(1, kMostRounds))
      ->capture_default_str();
  command.add_option("--seconds", arguments->choice.seconds, "no further round is begun after that many seconds")
      ->check(number_within(0, kMostSeconds))
      ->capture_default_str();
  command.add_option("-o,--out", arguments->folder, "folder for the results, replaced as a whole at the end");
  command.footer(
      "Exit code 0: a setting was chosen; 3: none solves every pose within the target; 2: refused."
      "\nExample: genu accuracy knee.toml --target 0.01mm --out out/accuracy");
  advice().hint("accuracy",
                "the verdict above says which settings met the target; `genu explain accuracy` says what they mean");
  command.callback([arguments, &exit_code] { exit_code = compare(*arguments); });
}

}  // namespace genu::cli
