// genu fit femur.stl --out fitted            polynomials for the contact surfaces of a mesh
//   1. read the mesh, find its sheets and arms, choose chart, patch and degree of each
//   2. write surfaces.toml (tables for a scene), coverage.svg, summary.json
// genu fit --scene knee.toml --out fitted    the same for all meshes of a scene, where its contacts travel
//   1. solve the scene, fit each mesh round the path of its contacts
//   2. write scene.toml, the scene with polynomials for meshes, and the files above; solve it and tell the difference
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/assemble/fit_mesh.h"
#include "genu/core/atomic_output.h"
#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/scene/reader.h"
#include "genu/scene/words.h"
#include "genu/study/fit_scene.h"
#include "print_error.h"

namespace genu::cli {
namespace {

struct FitOptions {
  std::string mesh, scene, folder, unit, chart, facing, name, body, like;
  std::vector<std::string> regions;
  int degree = 0;
  double margin = 8;  ///< mm
};

/// "-y", "z" or "0.1,0,1".
std::optional<Vec3> direction(const std::string& text) {
  const std::string axes = "xyz";
  const bool minus = !text.empty() && text.front() == '-';
  const std::string letter = minus ? text.substr(1) : text;
  if (letter.size() == 1 && axes.find(letter) != std::string::npos)
    return Vec3((minus ? -1 : 1) * Vec3::Unit(static_cast<Eigen::Index>(axes.find(letter))));
  Vec3 v;
  std::size_t from = 0;
  for (int k = 0; k < 3; ++k) {
    const std::size_t comma = text.find(',', from);
    if ((comma == std::string::npos) != (k == 2)) return std::nullopt;
    if (!CLI::detail::lexical_cast(text.substr(from, comma - from), v[k]) || !std::isfinite(v[k])) return std::nullopt;
    from = comma + 1;
  }
  const double largest = v.cwiseAbs().maxCoeff();  // taken out first: squares of large numbers overflow
  if (!(largest > 0)) return std::nullopt;
  return Vec3((v / largest).normalized());
}

/// FILE and NAME of "FILE:NAME"; an empty name of "FILE".
std::pair<std::string, std::string> like_file(const std::string& text) {
  const auto colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return {text, {}};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

/// The surface FILE:NAME, or the only one of FILE.
std::optional<KnownPatch> read_like(const std::string& text, Diagnostics& out) {
  const auto [file, name] = like_file(text);
  const bool named = file.size() < text.size();
  const auto scene = read_surface_file(file, out);
  if (!scene) return std::nullopt;
  const SurfaceDef* found = nullptr;
  std::string known;
  for (const SurfaceDef& s : scene->surfaces) {
    known += " " + s.name;
    if (s.name == name || (!named && scene->surfaces.size() == 1)) found = &s;
  }
  if (!found) {
    out.error(Code::unknown_name, file,
              named ? "there is no surface \"" + name + "\"; known:" + known
                    : "has several surfaces: name one, FILE:NAME, of" + known);
    return std::nullopt;
  }
  auto like = known_patch(*found);
  if (!like)
    out.error(Code::not_applicable, file,
              "surface \"" + found->name + "\" is no polynomial with a patch of both chart coordinates");
  return like;
}

void show(const std::vector<NamedFit>& fits) {
  for (const NamedFit& f : fits) {
    fmt::print("{}: {}\n", f.name, describe(f.fit));
    for (const std::string& doubt : doubts(f.fit)) fmt::print("  DOUBTFUL: {}\n", doubt);
  }
}

int written(const std::string& error, const FitOptions& options) {
  if (error.empty()) {
    fmt::print("written to {}\n", options.folder);
    return kExitOk;
  }
  print_error("{}\n", error);
  return kExitFailed;
}

/// What StagedFolder would refuse is refused before the work, and so is a folder that holds what is read.
bool can_write(const std::string& folder, const std::vector<std::string>& inputs, Diagnostics& out) {
  {
    StagedFolder probe("results");
    if (const auto refused = probe.open(folder)) {
      out.error(refused->code, {}, refused->text);
      return false;
    }
  }
  for (const std::string& file : inputs) {
    if (!folder_holds(folder, file)) continue;
    out.error(Code::would_lose_input, folder,
              "holds " + file + ", which would be lost with the folder: choose another folder");
    return false;
  }
  return true;
}

void check_name(const std::string& option, const std::string& name, Diagnostics& out) {
  if (!name.empty() && !is_name(name))
    out.error(Code::wrong_form, option + " \"" + name + "\"", "a name is a letter or _, then letters, digits, _ or -");
}

int fit_one(const FitOptions& options) {
  Diagnostics problems;
  FitMeshRequest request;
  request.file = options.mesh;
  if (!options.unit.empty()) request.file_unit = metres_in(options.unit);
  request.name = options.name;
  request.body = options.body;
  request.regions = options.regions;
  if (!options.chart.empty()) request.cylindrical = options.chart == "cylindrical";
  if (options.degree > 0) request.degree = options.degree;
  if (!options.facing.empty()) {
    request.facing = direction(options.facing);
    if (!request.facing)
      problems.error(Code::wrong_form, "--facing " + options.facing, "must be an axis such as -y, or x,y,z");
  }
  check_name("--name", options.name, problems);
  check_name("--body", options.body, problems);
  std::vector<std::string> inputs{options.mesh};
  if (!options.like.empty()) {
    request.like = read_like(options.like, problems);
    inputs.push_back(like_file(options.like).first);
  }
  std::vector<NamedFit> fits;
  double unit = 0;
  if (!problems.has_errors() && can_write(options.folder, inputs, problems)) fits = fit_mesh(request, problems, &unit);
  print(problems);
  if (problems.has_errors()) return kExitRefused;
  if (options.unit.empty())
    fmt::print("{}: units {} (guessed from the size; --units says it)\n", printable(options.mesh),
               length_unit_name(unit));
  show(fits);
  auto files = fit_files(fits);
  const std::string title = "fitted to " + std::filesystem::path(options.mesh).filename().string();
  files.emplace_back("surfaces.toml", surface_file(fits, title));
  return written(write_folder(options.folder, files), options);
}

int fit_all(const FitOptions& options) {
  Diagnostics problems;
  FitSceneRequest request;
  request.file = options.scene;
  request.margin = options.margin * units::kMillimetre;
  if (options.degree > 0) request.degree = options.degree;
  std::optional<SceneFits> found;
  found = fit_scene(request, options.folder, problems);
  print(problems);
  if (!found) return kExitRefused;
  show(found->fits);
  auto files = fit_files(found->fits);
  files.emplace_back("scene.toml", found->scene);
  const int code = written(write_folder(options.folder, files), options);
  if (code != kExitOk) return code;

  constexpr double kPrescribed = 1e-9;  // deg, mm: rounding of what is the same in both
  // The proof of the fit is the joint's motion.
  const std::string scene = options.folder + "/scene.toml";
  const auto prepared = prepare(scene, problems);
  print(problems, true);
  if (!prepared) return kExitFailed;
  ContactField field(prepared->model);
  const Solution fitted = solve(*prepared, field, {});
  const RunSummary &with = fitted.summary, &without = found->solution.summary;
  fmt::print("poses solved: {} of {} with polynomials, {} of {} with meshes; largest differences:\n", with.poses_solved,
             with.poses_asked, without.poses_solved, without.poses_asked);
  for (const auto& [name, worst] : pose_differences(prepared->scene, found->solution.poses, fitted.poses))
    if (worst > kPrescribed) fmt::print("  {:<24}{:.3g}\n", name, worst);
  for (const std::string& sentence : with.verdict)
    if (with.exit_code != kExitOk) fmt::print("{}\n", sentence);
  return with.exit_code;
}

}  // namespace

void add_fit(CLI::App& command, int& exit_code) {
  auto options = std::make_shared<FitOptions>();
  auto* mesh = command.add_option("MESH", options->mesh, "mesh file; its open sheets are the surfaces");
  auto* scene = command.add_option("--scene", options->scene, "scene whose meshes are fitted where contacts travel");
  mesh->excludes(scene);
  command.add_option("-o,--out", options->folder, "folder for the files, replaced as a whole")->required();
  command.add_option("--degree", options->degree, "total degree; chosen by cross-validation where not given")
      ->check(CLI::Range(kLowestFitDegree, kHighestFitDegree));
  command.add_option("--margin", options->margin, "with --scene: mm that patches go beyond the contacts")
      ->check(number_within(0.5, 100))
      ->needs(scene)
      ->capture_default_str();
  const auto of_mesh = [&](CLI::Option* option) { option->needs(mesh); };
  of_mesh(command.add_option("--units", options->unit, "of the mesh file; guessed from its size where not given")
              ->check(CLI::IsMember(length_unit_names())));
  of_mesh(
      command.add_option("--facing", options->facing,
                         "the way the surface looks, an axis (-y) or a direction (0,-1,0.5): needed for closed bones"));
  of_mesh(command.add_option("--region", options->regions,
                             "\"z < 0 and x > -5\", in the file's units: one surface each; may be repeated"));
  of_mesh(command.add_option("--chart", options->chart, "chosen where not given")
              ->check(CLI::IsMember({"cartesian", "cylindrical"})));
  of_mesh(
      command.add_option("--like", options->like,
                         "FILE or FILE:SURFACE whose chart, patch and degree are taken: only the terms are fitted"));
  of_mesh(command.add_option("--name", options->name, "of the surfaces; the file's where not given"));
  of_mesh(command.add_option("--body", options->body, "that the surfaces are on; \"body\" where not given"));
  command.footer(
      "Examples: genu fit femur.stl --out fitted\n"
      "          genu fit bone.stl --facing -y --region \"z < 0\" --out fitted\n"
      "          genu fit --scene knee.toml --out fitted");
  advice().hint("fit",
                "look at the lines marked DOUBTFUL; another --degree, --chart or a smaller patch may fit better");
  command.callback([options, &exit_code] {
    if (options->mesh.empty() == options->scene.empty()) {
      exit_code = refuse(Code::usage, "genu fit: name a mesh file or --scene SCENE");
    } else {
      exit_code = options->scene.empty() ? fit_one(*options) : fit_all(*options);
    }
  });
}

}  // namespace genu::cli
