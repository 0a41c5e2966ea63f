// genu import knee.osim --joints knee_r,pf_r --out knee
//   1. read the model, and poses, forces and meshes that belong to it; refuse with every error at once
//   2. write knee/scene.toml with the joints asked for, everything else frozen, and knee/import.csv
//   3. say in words what became of each kind of element
#include <memory>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/core/file_text.h"
#include "genu/study/import_model.h"

namespace genu::cli {
namespace {

struct ImportArguments {
  ModelImport import;
  std::string joints;
};

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream in(list);
  for (std::string name; std::getline(in, name, ',');) {
    const std::size_t from = name.find_first_not_of(' '), end = name.find_last_not_of(' ');
    if (from != std::string::npos) names.push_back(name.substr(from, end - from + 1));
  }
  return names;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

int import_it(const CLI::App& command, ImportArguments arguments) {
  ModelImport& asked = arguments.import;
  asked.joints = names_in(arguments.joints);
  Diagnostics problems;
  if (command.count("--row") > 0 && asked.pose.empty() && asked.forces.empty())
    problems.add(error_at({}, Code::no_effect, "--row", {}, "belongs to --pose or --forces"));
  if (problems.has_errors()) return refuse(problems);
  const auto report = import_model(asked, problems);
  print(problems, report && !report->written);
  if (!report) return kRefused;
  if (!report->written) return kFailed;
  const osim::ImportedScene& scene = report->scene;
  fmt::print("written     {}, import.csv\n", printable(report->file));
  fmt::print("bodies      {}\njoints      {}\n", joined(scene.bodies), joined(scene.joints));
  if (!asked.pose.empty()) fmt::print("pose        {} coordinates of row {}\n", report->coordinates, asked.row);
  if (!asked.forces.empty()) fmt::print("forces      {} muscles of row {}\n", report->tensions, asked.row);
  fmt::print("elements    {} kept, {} frozen, {} left out\n", scene.kept, scene.frozen, scene.left_out);
  for (const std::string& line : scene.summary) fmt::print("  {}\n", printable(line));
  fmt::print("next        genu check {}\n", printable(shell_word(report->file)));
  return kOk;
}

}  // namespace

void add_import(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<ImportArguments>();
  ModelImport& import = arguments->import;
  command.add_option("MODEL", import.model, "model of OpenSim 4 (.osim)")->required();
  command.add_option(
      "--joints", arguments->joints,
      "joints that move, with commas between; everything else is frozen. Where it is not given: all with "
      "six free axes between two bodies");
  command.add_option("--pose", import.pose,
                     "OpenSim's .sto or .mot of coordinates: where the rest is frozen, and the pose of the scene; else "
                     "the model's defaults");
  command.add_option("--forces", import.forces, "OpenSim's .sto of muscle forces, N; else no muscle pulls");
  command.add_option("--row", import.row, "row of these files, from 1")->capture_default_str();
  command.add_option("--geometry", import.geometry,
                     "folder of the model's mesh files; else beside the model, or in Geometry there");
  command.add_option("-o,--out", import.folder, "new folder for scene.toml and import.csv")
      ->required()
      ->check(not_empty());
  command.footer(
      "Nothing is ever replaced. What is what: docs/opensim.md.\n"
      "Example: genu import lenhart2015.osim --joints knee_r,pf_r --out knee");
  command.callback([arguments, &command, &exit_code] { exit_code = import_it(command, *arguments); });
}

}  // namespace genu::cli
