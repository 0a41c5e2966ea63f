// genu judge out/knee
//   1. find the scene in DIR/summary.json, or take --scene; say when it or a mesh has changed since
//   2. work out by itself what DIR/results.csv says, sharing no code with the solver
//   3. print each check with its worst value and tolerance; exit 3 where a pose called ok is rejected, or none is there
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/assemble/changed_scene.h"
#include "genu/core/atomic_output.h"
#include "genu/core/diagnostics.h"
#include "genu/judge/judge.h"
#include "genu/judge/run_folder.h"
#include "print_error.h"

namespace genu::cli {
namespace {

struct JudgeArguments {
  std::string folder, scene, out;
  judge::Options options;
  bool quiet = false;
};

/// What is wrong, on standard error.
int refused(const Diagnostics& diagnostics) {
  print(diagnostics);
  return kRefused;
}

int judge_folder(const JudgeArguments& arguments) {
  Diagnostics diagnostics;
  const bool csv = arguments.out.ends_with(".csv");
  if (!arguments.out.empty()) {
    if (!csv && !arguments.out.ends_with(".json"))
      diagnostics.error(Code::usage, arguments.out,
                        "the table of checks is .json or .csv: choose one of these endings");
    if (const auto kept = why_not_replaced(arguments.out, csv ? "check,numbers,poses,worst" : "\"accepted\":"))
      diagnostics.error(kept->code, {}, kept->text);
    if (diagnostics.has_errors()) return refused(diagnostics);
  }
  const auto folder = judge::read_run_folder(arguments.folder, arguments.scene, diagnostics);
  if (!folder) return refused(diagnostics);
  const auto scene = read_changed_scene(folder->scene, diagnostics);
  if (!scene) return refused(diagnostics);
  const std::string table = (std::filesystem::path(arguments.folder) / "results.csv").string();
  const auto found = judge::judge_results(*scene, folder->results, table, arguments.options, diagnostics);
  if (found && folder->ok_rows && *folder->ok_rows != found->judged)
    diagnostics.error(Code::results_changed, table,
                      fmt::format("has {} rows that are ok where summary.json counts {}: it was cut or changed "
                                  "since the run",
                                  found->judged, *folder->ok_rows));
  if (!found || diagnostics.has_errors()) return refused(diagnostics);
  print(diagnostics);
  if (!arguments.quiet) fmt::print("{}", judge::to_text(*found));
  if (!arguments.quiet && !folder->doubt.empty())
    fmt::print("the run has doubts, which no balance of forces settles: {}\n", printable(folder->doubt));
  if (!arguments.out.empty()) {
    const std::string error =
        write_file_atomically(arguments.out, csv ? judge::to_csv(*found) : judge::to_json(*found));
    if (!error.empty()) {
      print_error("genu: {}\n", printable(error));
      return kFailed;
    }
  }
  if (found->judged == 0) advice().next("no row is ok, so there is none to judge: the run's verdict says why");
  if (!found->accepted() && !diagnostics.items().empty())
    advice().next("the scene or the results have changed, as the warnings say: run the scene again, then judge that");
  return found->accepted() && found->judged > 0 ? kOk : kNotAllOk;
}

}  // namespace

void add_judge(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<JudgeArguments>();
  command.add_option("DIR", arguments->folder, "folder that `genu run` wrote")->required();
  command.add_option("--scene", arguments->scene, "scene file, where it is no longer where the summary says");
  command.add_option("-o,--out", arguments->out, "write the table of checks to this file: .json, or .csv");
  constexpr std::size_t kMostRows = 1'000'000;
  command
      .add_option("--every", arguments->options.every,
                  "overlap everywhere and pressure in every Nth row alone, which is what takes long")
      ->check(CLI::Range(std::size_t{1}, kMostRows))
      ->capture_default_str();
  command
      .add_option("--samples", arguments->options.samples,
                  "samples along each side of a surface that is looked over for overlap and pressure")
      ->check(CLI::Range(10, 2000))
      ->capture_default_str();
  command.add_flag("--quiet", arguments->quiet, "print errors only");
  command.footer("Example: genu judge out/knee");
  advice().hint("judge",
                "trust no row that is rejected above: run the scene again; if it is rejected again, report a bug with "
                "`genu run SCENE --out DIR --save-failure FILE`");
  command.callback([arguments, &exit_code] { exit_code = judge_folder(*arguments); });
}

}  // namespace genu::cli
