// genu export knee.toml --osim --out knee-osim
//   1. read the scene and its meshes; refuse with every error at once
//   2. write model.osim with bodies, joints, ligaments, cables and contact as far as OpenSim has them, and its meshes
//   3. say in words what was left out, or differs there
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "changes.h"
#include "commands.h"
#include "genu/core/file_text.h"
#include "genu/study/export_model.h"

namespace genu::cli {
namespace {

struct ExportArguments {
  ModelExport model{"", "", "", ""};
  bool osim = false;
};

int export_it(const ModelExport& asked) {
  Diagnostics problems;
  const auto report = export_model(asked, problems);
  print(problems, report && !report->written);
  if (!report) return kRefused;
  if (!report->written) return kFailed;
  const osim::ExportedModel& model = report->model;
  fmt::print("written     {}, export.csv{}{}\n", printable(report->file), model.forces.empty() ? "" : ", forces.sto",
             report->meshes > 0 ? fmt::format(", {} meshes in Geometry", report->meshes) : "");
  fmt::print("objects     {} kept, {} left out\n", model.kept, model.left_out);
  for (const std::string& line : model.summary) fmt::print("  {}\n", printable(line));
  const auto forces = std::filesystem::path(report->file).parent_path() / "forces.sto";
  std::string joints;
  for (const std::string& joint : model.joints) joints += (joints.empty() ? "" : ",") + joint;
  fmt::print("next        genu import {} --joints {}{} --out ...\n", printable(shell_word(report->file)), joints,
             model.forces.empty() ? std::string() : " --forces " + printable(shell_word(forces.string())));
  return kOk;
}

}  // namespace

void add_export(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<ExportArguments>();
  ModelExport* const asked = &arguments->model;
  command.add_option("SCENE", asked->source.path, "scene file (TOML)")->required();
  command.add_flag("--osim", arguments->osim, "a model of OpenSim 4, with the elements of OpenSim-JAM")->required();
  command.add_option("-o,--out", asked->folder, "new folder for model.osim, export.csv, forces.sto and Geometry")
      ->required()
      ->check(not_empty());
  command.add_option("--columns", asked->columns, "names of coordinates, \"knee.flexion=knee_angle_r, ...\"");
  command.add_option("--side", asked->side, "r or l, at the end of all other names")->check(CLI::IsMember({"r", "l"}));
  add_changes(command, asked->source.changes);
  command.footer(
      "Nothing is ever replaced. What is what: docs/opensim.md.\n"
      "Example: genu export meshes/joints/total-knee.toml --osim --out out/total-knee");
  command.callback([arguments, &exit_code] { exit_code = export_it(arguments->model); });
}

}  // namespace genu::cli
