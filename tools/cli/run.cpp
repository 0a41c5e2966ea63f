// genu run knee.toml --out out/knee
//   1. read scene and meshes; refuse with every error at once
//   2. solve pose after pose
//   3. write results.csv, events.csv, curves.svg, report.html, summary.json; print a short table and the verdict
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "changes.h"
#include "colour.h"
#include "commands.h"
#include "genu/core/cancelled.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/store/checkpoint.h"
#include "genu/store/compare.h"
#include "genu/study/run_scene.h"
#include "print_error.h"
#include "progress.h"
#include "shown_columns.h"

namespace genu::cli {
namespace {

/// Every equilibrium that was found, and how many starts found none.
void print_starts(const ResultTable& starts, double spread) {
  std::vector<std::string> columns = starts.columns();
  columns.erase(columns.begin() + 2, columns.begin() + 4);  // the first start and its status: in starts.csv
  columns.pop_back();                                       // the residual as well
  ResultTable found;
  for (const std::string& name : starts.columns()) found.add_column(name);
  for (std::size_t row = 0; row < starts.rows(); ++row) {
    if (!(starts.number(row, "equilibrium") > 0)) continue;
    found.add_row();
    for (std::size_t c = 0; c < starts.columns().size(); ++c) found.set(c, starts.at(row, c));
  }
  const std::size_t failed = starts.rows() - found.rows();
  fmt::print("equilibria at the first pose: {}, from starts within {:g} deg{}\n", found.rows(), spread,
             failed > 0 ? fmt::format("; {} of the starts found none", failed) : "");
  bool any_stable = false;
  for (std::size_t row = 0; row < found.rows(); ++row)
    any_stable |= std::get<std::string>(found.at(row, found.column_index("stability"))) == "stable";
  if (found.rows() > 0 && !any_stable)
    fmt::print("none of them is stable: the joint stays at none of these poses. Try a larger --spread.\n");
  constexpr std::size_t kRows = 20;
  if (found.rows() > 0) fmt::print("{}\n", to_text(found, columns, 4, kRows));
}

/// Flushes round-off to zero.
double without_rounding(double x) { return std::abs(x) < 1e-9 ? 0 : x; }

/// "row 12, knee.flexion_deg 55": a row of results.csv and what is prescribed there.
std::string place_of(const Solution& solution, std::size_t row) {
  std::string place = fmt::format("row {}", row + 1);
  for (const std::string& column : solution.prescribed)
    if (solution.poses.has_column(column))
      place += fmt::format(", {} {:.4g}", column, without_rounding(solution.poses.number(row, column)));
  return place;
}

/// Variants that do not solve all poses make error bars too small.
void print_lost_variants(const RunSummary& summary) {
  std::string lost;
  int count = 0;
  for (const RunSummary::Variant& v : summary.variants) {
    if (v.poses_solved >= summary.poses_solved) continue;
    lost += fmt::format("{}{}: {} of {}", count++ == 0 ? "" : "; ", v.name, v.poses_solved, summary.poses_solved);
  }
  if (count == 0) return;
  fmt::print(
      "  {} of {} other surfaces do not solve all poses ({}). There a bar keeps their last difference, or none "
      "if they solve no pose: it may be too small.\n\n",
      count, summary.variants.size(), lost);
}

/// The error bars of the columns shown, the largest and what causes it.
void print_error_bars(const Solution& solution) {
  const std::vector<std::string> shown = columns_of_run(solution.poses);
  ResultTable table;
  for (const char* column : {"error bar of", "median", "largest", "at", "mostly"}) table.add_column(column);
  for (const ErrorBars::Largest& l : solution.error_bars->largest) {
    if (std::find(shown.begin(), shown.end(), l.column) == shown.end() || !(l.largest > 1e-9))
      continue;  // what is prescribed
    table.add_row();
    table.set(0, l.column);
    table.set(1, l.median);
    table.set(2, l.largest);
    table.set(3, place_of(solution, l.row));
    table.set(4, std::string(to_string(l.cause)));
  }
  if (table.rows() > 0) fmt::print("{}\n", to_text(table, table.columns(), 4, table.rows()));
  print_lost_variants(solution.summary);
}

/// The verdict in its colour.
void print_summary(const RunSummary& summary) {
  const std::string text = to_text(summary);
  const std::size_t verdict = text.rfind("  verdict ");
  if (verdict == std::string::npos) {
    fmt::print("{}", text);
    return;
  }
  const std::size_t end = text.find('\n', verdict);
  constexpr Colour kColours[] = {Colour::green, Colour::yellow, Colour::red};
  fmt::print(
      "{}{}{}", text.substr(0, verdict),
      painted(text.substr(verdict, end - verdict), kColours[static_cast<int>(summary.verdict_class)], STDOUT_FILENO),
      text.substr(end));
}

/// Where results go that have no --out: out/knee for knee.toml; out/lenhart2015-cartilage for
/// lenhart2015/scene-cartilage.toml.
std::string usual_folder(const std::string& scene) {
  std::error_code none;
  const std::filesystem::path file = std::filesystem::absolute(scene, none).lexically_normal();
  std::string name = file.stem().string();
  const std::string folder = file.parent_path().filename().string();
  if (name.starts_with("scene") && !folder.empty()) name = folder + name.substr(std::string("scene").size());
  return (std::filesystem::path("out") / name).string();
}

struct RunArguments {
  std::string scene, folder;
  SceneChanges changes;
  int starts = 0;
  double spread = 20;
  bool error_bars = false, pressure_maps = false, no_report = false, quiet = false, resume = false;
  std::string save_failure, beside, beside_columns;
  double checkpoint = RunOptions().checkpoint_seconds;
};

/// The status of the last row, for the hint at the end.
void note_status(const ResultTable& poses) {
  if (poses.rows() == 0 || !poses.has_column("status")) return;
  advice().status(std::get<std::string>(poses.at(poses.rows() - 1, poses.column_index("status"))));
}

/// Reports the rows that an exception has left for --resume, then throws it again.
int run_with_checkpoint(const RunArguments& arguments, const RunOptions& options, Diagnostics& diagnostics,
                        Solution& solution) {
  try {
    return run_scene({arguments.scene, arguments.changes}, arguments.folder, options, diagnostics, &solution);
  } catch (...) {
    const std::string file = beside(arguments.folder, ".checkpoint");
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored))
      print_error("genu: the rows computed so far are kept in {}; --resume continues from there\n", file);
    throw;
  }
}

/// The page with both results over each other, beside their folders.
int write_comparison(const RunArguments& arguments) {
  const std::string page = arguments.folder + ".compared.html";
  Diagnostics diagnostics;
  const int code = compare_results({arguments.beside, arguments.folder}, page, diagnostics);
  print(diagnostics, code == kFailed);
  if (code == kOk && !arguments.quiet) fmt::print("  {:<12}{}\n", "compared", page);
  return code;
}

/// Whether --beside names curves, and not a folder for the scene as it is written.
bool beside_names_a_table(const std::string& beside) {
  const std::filesystem::path path = beside;
  const std::string kind = path.extension().string();
  std::error_code none;
  return kind == ".csv" || kind == ".sto" || kind == ".mot" || std::filesystem::is_regular_file(path, none);
}

int run_scene_file(const RunArguments& arguments) {
  const auto& [scene, folder, changes, starts, spread, error_bars, pressure_maps, no_report, quiet, resume, failure,
               beside, beside_columns, checkpoint] = arguments;
  RunOptions options;
  options.starts = starts;
  options.error_bars = error_bars;
  options.pressure_maps = pressure_maps;
  options.resume = resume;
  options.checkpoint_seconds = checkpoint;
  options.save_failure = failure;
  options.beside = beside_names_a_table(beside) ? beside : std::string();
  options.beside_columns = beside_columns;
  options.report = !no_report;
  options.spread = spread * units::kDegree;
  auto progress = std::make_shared<Progress>();
  if (!quiet) {
    options.progress = [progress](int done, int asked) { (*progress)(done, asked, "poses"); };
    options.varied_progress = [progress](int done, int asked) { (*progress)(done, asked, "poses for error bars"); };
  }
  options.cancelled = stop_on_interrupt();
  Diagnostics diagnostics;
  Solution solution;
  const int code = run_with_checkpoint(arguments, options, diagnostics, solution);
  progress->finish();
  print(diagnostics, code == kExitFailed);
  note_status(solution.poses);
  const std::string mark = solution.summary.partial ? ".partial" : "";
  if (solution.stopped == "interrupted") advice().next("the same command with --resume continues, if rows were kept");
  const bool unsaid = quiet && (code == kExitIncomplete || code == kExitDoubtful);  // why, that is
  if ((!mark.empty() || unsaid) && !solution.summary.verdict.empty())
    print_error("{}\n", printable(solution.summary.verdict.front()));
  const bool any = solution.poses.rows() > 0;  // none where it was interrupted in the first pose
  if (code == kExitRefused || (code == kExitFailed && !any)) return code;
  if (!quiet) {
    constexpr std::size_t kRows = 11;
    fmt::print("{}\n\n", printable(solution.summary.title));
    if (any) fmt::print("{}\n", to_text(solution.poses, columns_of_run(solution.poses), 4, kRows));
    if (solution.starts) print_starts(*solution.starts, spread);
    if (solution.error_bars)
      print_error_bars(solution);
    else if (error_bars)
      fmt::print("no error bars: the scene fits no smooth surface to a mesh, and has nothing to vary\n");
    if (pressure_maps && solution.pressure_files.empty()) fmt::print("no pressure maps: the scene has no cartilage\n");
    print_summary(solution.summary);
  }
  if ((code != kExitFailed || !mark.empty()) && !diagnostics.has_errors() && !quiet)
    fmt::print("  {:<12}{}/results{}.csv, events{}.csv, {}{}{}curves.svg, {}summary.json\n", "written", solution.folder,
               mark, mark, solution.starts ? "starts.csv, " : "",
               solution.error_bars ? "error_bars.csv, error_shares.csv, " : "", listed(solution.pressure_files),
               no_report ? "" : "report.html, ");
  return code;
}

/// Both without slashes at the end.
bool same_folder(const std::string& one, const std::string& other) {
  const auto place = [](const std::string& folder) {
    std::error_code none;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(folder), none);
  };
  return place(one) == place(other);
}

/// Of two runs: what is not solved weighs more than what is doubtful.
int worse(int one, int other) { return one == kNotAllOk || other == kNotAllOk ? kNotAllOk : std::max(one, other); }

/// With --beside: the scene as it is written, then as it is changed, then the page of both.
int run_both(const RunArguments& arguments) {
  if (arguments.beside.empty() || beside_names_a_table(arguments.beside)) return run_scene_file(arguments);
  if (!arguments.beside_columns.empty())
    return refuse(Code::usage, "--columns is of a table beside the results, and --beside names a folder");
  if (arguments.no_report || (arguments.changes.empty()))
    return refuse(Code::usage, arguments.no_report
                                   ? "--beside compares the pages that --no-report leaves out"
                                   : "--beside names no table (.csv, .sto, .mot), and as a folder for the scene as it "
                                     "is written it needs --without or --set: nothing is changed");
  RunArguments changed = arguments;
  changed.folder = beside(arguments.folder, "");
  changed.beside = beside(arguments.beside, "");
  if (same_folder(changed.beside, changed.folder)) return refuse(Code::usage, "--beside and --out are the same folder");
  RunArguments written = changed;
  written.changes = {};
  written.folder = changed.beside;
  if (!written.save_failure.empty()) written.save_failure += ".as-written";
  const int first = run_scene_file(written);
  if (first == kRefused || first == kFailed || asked_to_stop(stop_on_interrupt())) return first;
  const int second = run_scene_file(changed);
  if (second == kRefused || second == kFailed) return second;
  const int compared = write_comparison(changed);
  return compared != kOk ? compared : worse(first, second);
}

}  // namespace

void add_run(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<RunArguments>();
  command.add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
  CLI::Option* out = command.add_option(
      "-o,--out", arguments->folder,
      "folder for the results, replaced as a whole at the end; left out: out/SCENE, if nothing is changed");
  constexpr int kMostStarts = 100'000;
  CLI::Option* starts =
      command
          .add_option("--starts", arguments->starts,
                      "search for equilibria at the first pose from this many starts, list them in starts.csv")
          ->check(CLI::Range(1, kMostStarts));
  constexpr double kMostSpread = 180;  // deg
  command
      .add_option("--spread", arguments->spread,
                  "largest change of a free angle of the starts, in deg; lengths change by half of the characteristic "
                  "length for each 20 deg")
      ->check(number_within(0.1, kMostSpread))
      ->needs(starts)
      ->capture_default_str();
  command.add_flag("--error-bars", arguments->error_bars,
                   "solve the scene also on other surfaces that fit its meshes (fits, noise, fewer points), and "
                   "write the uncertainty of each result");
  command.add_flag("--pressure-maps", arguments->pressure_maps,
                   "write force, pressure, depth and area of each triangle of each cartilage layer at every pose, "
                   "pressures_CONTACT.csv");
  command.add_flag("--resume", arguments->resume,
                   "continue an earlier run into DIR that was killed or stopped (DIR.checkpoint); the results are "
                   "those of an undisturbed run, to the byte");
  constexpr double kMostSeconds = 86'400;
  command
      .add_option("--checkpoint", arguments->checkpoint,
                  "seconds between additions of new rows to DIR.checkpoint; 0: as often as possible")
      ->check(number_within(0, kMostSeconds))
      ->capture_default_str();
  command
      .add_option("--save-failure", arguments->save_failure,
                  "if a pose is not ok, write a file that repeats the failure with genu reproduce: the needed part "
                  "of the meshes, no names of folders; of the scene as its file says (--beside) into "
                  "FILE.as-written")
      ->check(not_empty());
  command.add_flag("--no-report", arguments->no_report,
                   "leave out report.html, the page that shows the joint and its results in a browser");
  CLI::Option* beside =
      command
          .add_option(
              "--beside", arguments->beside,
              "a table of measured or published curves (CSV, .sto, .mot) that report.html shows as points beside "
              "the computed curves; its columns have the names of results.csv. Or, with --without or --set, a folder: "
              "the scene is also run into it as its file says, and both results are shown in one page, "
              "DIR.compared.html")
          ->check(not_empty());
  command
      .add_option("--columns", arguments->beside_columns,
                  "which column of --beside is which of results.csv, if the names differ: "
                  "\"knee.flexion=angle[deg], knee.adduction=add[rad]\"")
      ->needs(beside);
  command.add_flag("--quiet", arguments->quiet, "print errors only");
  add_changes(command, arguments->changes);
  command.footer(
      "Examples: genu run knee.toml\n          genu run knee.toml --out out/knee --beside measured.csv\n"
      "          genu run knee.toml --without \"ACL*\" --beside out/intact --out out/cut");
  advice().hint("run", "the verdict above says where, why and what to change; the rows before that are valid");
  command.callback([arguments, out, &exit_code] {
    if (out->count() == 0 && !arguments->changes.empty()) {
      exit_code = refuse(Code::usage,
                         "--without and --set need --out DIR: without it results go where those of the scene as "
                         "written belong, " +
                             usual_folder(arguments->scene));
      return;
    }
    if (out->count() == 0) {
      arguments->folder = usual_folder(arguments->scene);
      std::error_code none;
      if (!arguments->quiet && std::filesystem::exists(arguments->scene, none))
        print_error("results go to {}; another folder: --out DIR\n", arguments->folder);
    }
    exit_code = run_both(*arguments);
  });
}

}  // namespace genu::cli
