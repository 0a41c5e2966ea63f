// genu convert out/knee --to vtk --out out/paraview
//   1. find the scene in DIR/summary.json, or take --scene; say when it or a mesh has changed since
//   2. read DIR/results.csv, and build the surfaces again for their shapes and the directions of contact forces
//   3. write poses.pvd with its .vtp files, or OpenSim's .mot and .sto
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "commands.h"
#include "genu/core/atomic_output.h"
#include "genu/core/diagnostics.h"
#include "genu/judge/run_folder.h"
#include "genu/results/storage_text.h"
#include "genu/store/convert.h"

namespace genu::cli {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::string folder, scene, to;
  ConvertOptions options;
  bool quiet = false;
};

/// What --to and the ending of --out ask for together; an error where they do not go together.
std::string choose_target(const std::string& to, const std::string& out, ConvertTo& target) {
  const bool mot = out.ends_with(".mot"), sto = out.ends_with(".sto");
  if (mot || sto) target = mot ? ConvertTo::motion : ConvertTo::forces;
  if (mot || sto) return to.empty() || to == "opensim" ? "" : "--to " + to + " writes a folder, not " + out;
  if (out.ends_with(".pvd") || out.ends_with(".vtp"))
    return "a series for ParaView is a folder of many files: --to vtk --out FOLDER writes FOLDER/poses.pvd";
  if (to.empty()) return "give --to vtk or --to opensim, or name a file --out FILE.mot or FILE.sto";
  target = to == "vtk" ? ConvertTo::vtk : ConvertTo::opensim;
  return {};
}

/// Why the target must not be written; none if it may. Asked before the work.
std::optional<Fault> why_not_written(const ConvertArguments& arguments, const std::string& scene) {
  const bool folder = arguments.options.to == ConvertTo::vtk || arguments.options.to == ConvertTo::opensim;
  const std::string& out = arguments.options.out;
  if (!folder) return why_not_replaced(out, kStorageMark);
  for (const std::string& input : {(fs::path(arguments.folder) / "results.csv").string(), scene})
    if (folder_holds(out, input))
      return Fault{Code::would_lose_input, out + ": holds " + input + ", which would be lost: choose another folder"};
  StagedFolder probe("converted results");
  return probe.open(out);
}

void print_error(const ConvertArguments& arguments, const ConvertFound& found) {
  const std::string& out = arguments.options.out;
  constexpr double kMegabyte = 1e6;
  switch (arguments.options.to) {
    case ConvertTo::vtk:
      fmt::print("{}: for ParaView, {} files, {:.1f} MB\n", (fs::path(out) / "poses.pvd").string(), found.files,
                 static_cast<double>(found.bytes) / kMegabyte);
      break;
    case ConvertTo::opensim:
      fmt::print("{}: motion.mot, forces.sto\n", out);
      break;
    default:
      fmt::print("{}\n", out);
  }
  fmt::print("{} row{}; time is {}\n", found.rows, found.rows == 1 ? "" : "s",
             found.time == "row" ? "the row of results.csv" : found.time);
  if (found.left_out > 0)
    fmt::print("{} row{} without a solved pose left out\n", found.left_out, found.left_out == 1 ? "" : "s");
}

int convert(ConvertArguments& arguments) {
  Diagnostics diagnostics;
  const auto refused = [&] {
    print(diagnostics);
    return kRefused;
  };
  if (const std::string error = choose_target(arguments.to, arguments.options.out, arguments.options.to);
      !error.empty()) {
    diagnostics.error(Code::usage, {}, error);
    return refused();
  }
  const auto folder = judge::read_run_folder(arguments.folder, arguments.scene, diagnostics, true);
  if (!folder) return refused();
  if (const auto refusal = why_not_written(arguments, folder->scene.path)) {
    diagnostics.error(refusal->code, {}, refusal->text);
    return refused();
  }
  const std::string table = (fs::path(arguments.folder) / "results.csv").string();
  const auto read = read_results(folder->scene, folder->results, table, diagnostics);
  if (!read) return refused();
  ConvertFound found;
  const int code = convert_results(*read, arguments.options, diagnostics, found);
  print(diagnostics, code == kFailed);
  if (code == kOk && !arguments.quiet) print_error(arguments, found);
  return code;
}

}  // namespace

void add_convert(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<ConvertArguments>();
  command.add_option("DIR", arguments->folder, "folder that genu run or genu evaluate wrote")->required();
  command
      .add_option("--to", arguments->to,
                  "vtk: poses.pvd and .vtp files, for ParaView; opensim: motion.mot and forces.sto")
      ->check(CLI::IsMember({"vtk", "opensim"}));
  command
      .add_option("-o,--out", arguments->options.out, "folder to be written; or FILE.mot, FILE.sto for one of these")
      ->required();
  command.add_option("--scene", arguments->scene, "scene file, where it is no longer where the summary says");
  command.add_option("--time", arguments->options.time,
                     "column of results.csv used as time, such as knee.flexion_deg, or row (else time_s)");
  command.add_option("--every", arguments->options.every, "take every so many rows")
      ->check(number_within(1, 1e9))
      ->capture_default_str();
  command.add_option("--columns", arguments->options.names.columns,
                     "for OpenSim: names of coordinates, \"knee.flexion=knee_angle_r, knee.x=knee_tx_r\"");
  command.add_option("--side", arguments->options.names.side, "for OpenSim: r or l, at the end of all other names")
      ->check(CLI::IsMember({"r", "l"}));
  command.add_flag("--quiet", arguments->quiet, "print errors only");
  command.footer("Example: genu convert out/knee --to vtk --out out/paraview");
  command.callback([arguments, &exit_code] { exit_code = convert(*arguments); });
}

}  // namespace genu::cli
