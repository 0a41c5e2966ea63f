// genu evaluate knee.toml --poses measured.mot --out out/measured
//   1. read scene, meshes and poses; refuse with every error at once
//   2. compute contacts, ligaments and loads at each pose as it is given
//   3. print which column was taken for what, and a short table; write results.csv, curves.svg, summary.json
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "advice.h"
#include "changes.h"
#include "commands.h"
#include "genu/study/evaluate.h"

namespace genu::cli {
namespace {

struct EvaluateArguments {
  SceneChanges changes;
  std::string scene, poses, folder;
  PoseColumnOptions columns;
  bool pressure_maps = false, quiet = false;
};

void print_columns(const RunSummary::GivenPoses& given) {
  ResultTable table;
  for (const char* column : {"column", "taken for", "in", "because of"}) table.add_column(column);
  for (const auto& c : given.columns) {
    table.add_row();
    table.set(0, printable(c.column));
    table.set(1, c.coordinate);
    table.set(2, c.unit);
    table.set(3, c.how);
  }
  fmt::print("{}", to_text(table, table.columns(), 0, table.rows()));
  if (given.ignored.empty()) return;
  constexpr std::size_t kTold = 6;
  std::string names;
  for (std::size_t k = 0; k < std::min(kTold, given.ignored.size()); ++k)
    names += (k > 0 ? ", " : "") + printable(given.ignored[k]);
  fmt::print("  ignored: {} other column{} ({}{})\n", given.ignored.size(), given.ignored.size() == 1 ? "" : "s", names,
             given.ignored.size() > kTold ? ", ..." : "");
}

/// The rotations, then what contact is like.
std::vector<std::string> columns_of_evaluation(const ResultTable& table) {
  constexpr std::size_t kMost = 10;
  std::vector<std::string> columns;
  const auto ends_with = [](const std::string& s, const std::string& end) {
    return s.size() > end.size() && s.compare(s.size() - end.size(), end.size(), end) == 0;
  };
  for (const std::string& name : table.columns()) {
    const bool whole = name.find('.') == name.rfind('.');
    const bool layer_force =
        ends_with(name, ".force_N") && table.has_column(name.substr(0, name.size() - 7) + "area_mm2");
    if (whole && columns.size() < kMost &&
        (ends_with(name, "_deg") || ends_with(name, ".gap_mm") || ends_with(name, ".area_mm2") || layer_force))
      columns.push_back(name);
  }
  return columns;
}

int evaluate(const EvaluateArguments& arguments) {
  EvaluateOptions options;
  options.columns = arguments.columns;
  options.pressure_maps = arguments.pressure_maps;
  options.cancelled = stop_on_interrupt();
  Diagnostics diagnostics;
  Evaluation found;
  const int code = evaluate_scene({arguments.scene, arguments.changes}, arguments.poses, arguments.folder, options,
                                  diagnostics, &found);
  print(diagnostics, code == kExitFailed);
  if (code == kExitRefused || arguments.quiet) return code;
  constexpr std::size_t kRows = 11;
  print_columns(*found.summary.given);
  fmt::print("\n{}\n\n{}\n", printable(found.summary.title),
             to_text(found.poses, columns_of_evaluation(found.poses), 4, kRows));
  for (const std::string& sentence : found.summary.verdict)
    fmt::print("  {:<12}{}\n", &sentence == &found.summary.verdict.front() ? "verdict" : "", printable(sentence));
  if (arguments.pressure_maps && found.pressure_files.empty())
    fmt::print("no pressure maps: the scene has no cartilage\n");
  if (code != kExitFailed)
    fmt::print("  {:<12}{}/results.csv, {}curves.svg, summary.json\n", "written", found.folder,
               listed(found.pressure_files));
  return code;
}

}  // namespace

void add_evaluate(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<EvaluateArguments>();
  command.add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
  command
      .add_option("--poses", arguments->poses,
                  "table of poses: CSV with a row of names (results.csv of a run is one), or OpenSim's .sto or .mot")
      ->required();
  command.add_option("-o,--out", arguments->folder, "folder for the results, replaced as a whole at the end")
      ->required();
  command.add_option("--columns", arguments->columns.columns,
                     "which column is which coordinate, if the names differ: "
                     "\"knee.flexion=knee_angle_r[deg], knee.x=tx[mm], time=t\"");
  command.add_option("--transforms", arguments->columns.transforms,
                     "columns of 4x4 matrices (16 numbers row by row, or 12) of a joint's child in its parent, in the "
                     "place of its coordinates: \"knee=T[mm]\" for T11 ... T44, \"knee=2-17[mm]\" by places");
  command.add_option("--units", arguments->columns.units,
                     "units of columns without one, such as deg,mm (else those of the file, or rad,m)");
  command.add_flag("--pressure-maps", arguments->pressure_maps,
                   "write force, pressure, depth and area of each triangle of each cartilage layer at every pose, "
                   "pressures_CONTACT.csv");
  command.add_flag("--quiet", arguments->quiet, "print errors only");
  add_changes(command, arguments->changes);
  command.footer(
      "Example: genu evaluate knee.toml --poses measured.mot --columns \"knee.flexion=knee_angle_r[deg]\" --out "
      "out/measured");
  advice().hint("evaluate", "the verdict above names the rows; results.csv has all that could be evaluated");
  command.callback([arguments, &exit_code] { exit_code = evaluate(*arguments); });
}

}  // namespace genu::cli
