// genu mesh knee.toml --edge 1 --out meshes
//   1. read the scene, or the surfaces.toml that `genu fit` writes
//   2. cut each surface that has a formula (or only those named) into triangles; with --thickness close open ones
//   3. write DIR/<surface>.stl, .ply or .obj, in the frame of the surface's body
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "commands.h"
#include "genu/core/diagnostics.h"
#include "genu/geometry/mesh_check.h"
#include "genu/geometry/mesh_writer.h"
#include "genu/geometry/tessellate.h"
#include "genu/geometry/thicken.h"
#include "genu/run/build_surface.h"
#include "genu/scene/reader.h"

namespace genu::cli {
namespace {

constexpr int kOk = 0, kFailed = 1, kRefused = 2;
constexpr double kReach = 0.05;                     // m
constexpr double kSmallest = 1e-6, kLargest = 1e6;  // of lengths, in the unit of the command
const std::string kTitle = "genu mesh: ";           // of every file, by which it is known again

struct MeshOptions {
  std::string scene, folder, unit = "mm", format = "stl";
  std::vector<std::string> surfaces;
  double edge = 0, reach = 0, thickness = 0;  ///< in `unit`
};

// The surfaces to mesh; says in `out` which names cannot be.
std::vector<const SurfaceDef*> choose(const Scene& scene, const MeshOptions& options, Diagnostics& out) {
  std::vector<const SurfaceDef*> chosen;
  std::string known = "known:";
  for (const SurfaceDef& s : scene.surfaces) known += " " + s.name;
  for (const std::string& name : options.surfaces) {
    const auto found =
        std::find_if(scene.surfaces.begin(), scene.surfaces.end(), [&](const SurfaceDef& s) { return s.name == name; });
    if (found == scene.surfaces.end())
      out.error(scene.file, "there is no surface \"" + name + "\"; " + known);
    else if (found->shape == SurfaceDef::Shape::mesh)
      out.error(scene.file, "surface \"" + name + "\" is a mesh already");
    else
      chosen.push_back(&*found);
  }
  if (!options.surfaces.empty()) return chosen;
  for (const SurfaceDef& s : scene.surfaces) {
    if (s.shape != SurfaceDef::Shape::mesh) chosen.push_back(&s);
  }
  if (chosen.empty()) out.error(scene.file, "has no surface with a formula");
  return chosen;
}

int refuse(const Diagnostics& problems) {
  for (const Diagnostic& d : problems.items()) fmt::print(stderr, "{}\n", to_string(d));
  return kRefused;
}

/// A file of the same name that someone else wrote, as the mesh a surface was measured on, is not replaced.
void refuse_foreign(const std::string& path, Diagnostics& out) {
  std::error_code code;
  if (!std::filesystem::exists(std::filesystem::symlink_status(path, code)) || has_title(path, kTitle)) return;
  out.error(path, "is there already and was not written by genu mesh: it will not be replaced; choose another folder");
}

void describe(const std::string& path, const Mesh& mesh, double wanted, const MeshOptions& options, double unit) {
  const MeshReport report = check_mesh(mesh);
  fmt::print("{}: {} vertices, {} triangles, edges {:.3g} .. {:.3g} .. {:.3g} {}, smallest angle {:.1f} deg\n", path,
             report.vertices, report.triangles, report.edge_length[0] / unit, report.edge_length[2] / unit,
             report.edge_length[4] / unit, options.unit, smallest_angle(mesh) * 180 / std::numbers::pi);
  if (report.edge_length[2] > 1.2 * wanted) {
    fmt::print(stderr,
               "{}: warning: coarser than --edge {}: a surface of its kind gets no more than about {} triangles\n",
               printable(path), options.edge, report.triangles);
  }
}

int mesh_scene(const MeshOptions& options) {
  const double unit = options.unit == "m" ? 1.0 : 1e-3;
  Diagnostics problems;
  const std::optional<Scene> scene = read_surface_file(options.scene, problems);
  if (!scene) return refuse(problems);
  const std::vector<const SurfaceDef*> chosen = choose(*scene, options, problems);
  std::vector<std::shared_ptr<const Surface>> surfaces;
  for (const SurfaceDef* def : chosen) {
    surfaces.push_back(within_patch(make_analytic_surface(*def), *def));
    if (!surfaces.back())
      problems.error(scene->file, "surface \"" + def->name + "\" has sizes or a patch that make no surface");
  }
  if (problems.has_errors()) return refuse(problems);
  std::vector<Mesh> meshes;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const double reach = options.reach > 0 ? options.reach * unit : kReach;
    meshes.push_back(surfaces[k]->triangles(options.edge * unit, chosen[k]->placement.p, reach));
    if (options.thickness > 0) {
      std::string why;
      meshes[k] = thicken(meshes[k], *surfaces[k], options.thickness * unit, options.edge * unit, why);
      if (!why.empty()) problems.error(scene->file, "surface \"" + chosen[k]->name + "\" " + why);
    }
  }
  if (problems.has_errors()) return refuse(problems);

  const auto path_of = [&](const SurfaceDef& s) { return options.folder + "/" + s.name + "." + options.format; };
  for (const SurfaceDef* def : chosen) refuse_foreign(path_of(*def), problems);
  if (options.folder.empty()) problems.error("--out", "names no folder");
  if (problems.has_errors()) return refuse(problems);
  std::error_code failure;
  std::filesystem::create_directories(options.folder, failure);
  if (failure) {
    fmt::print(stderr, "{}: cannot be made a folder: {}\n", options.folder, failure.message());
    return kFailed;
  }
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::string path = path_of(*chosen[k]);
    const std::string title = fmt::format("{}{}, edge {} {}", kTitle, chosen[k]->name, options.edge, options.unit);
    if (const std::string error = write_mesh(meshes[k], path, unit, title); !error.empty()) {
      fmt::print(stderr, "{}\n", error);
      return kFailed;
    }
    describe(path, meshes[k], options.edge * unit, options, unit);
  }
  return kOk;
}

}  // namespace

void add_mesh(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<MeshOptions>();
  CLI::App* command =
      app.add_subcommand("mesh", "Cut a scene's surfaces into triangles and write them as STL, PLY or OBJ");
  command->add_option("SCENE", options->scene, "scene file, or the surfaces.toml of genu fit")->required();
  command->add_option("SURFACE", options->surfaces, "surfaces to mesh; all that have a formula where none is named");
  command
      ->add_option("--edge", options->edge, "length of the triangles' edges; shorter where the surface bends strongly")
      ->check(number_within(kSmallest, kLargest))
      ->required();
  command->add_option("--unit", options->unit, "unit of --edge, --reach and the files")
      ->check(CLI::IsMember({"mm", "m"}))
      ->capture_default_str();
  command->add_option("--reach", options->reach, "how far planes, cylinders and polynomials go; 50 mm where not given")
      ->check(number_within(kSmallest, kLargest));
  command->add_option("--format", options->format, "of the files: stl is binary float32, ply binary float64, obj text")
      ->check(CLI::IsMember({"stl", "ply", "obj"}))
      ->capture_default_str();
  command
      ->add_option("--thickness", options->thickness,
                   "closes open surfaces: watertight solids so thick, behind the surface; closed ones stay")
      ->check(number_within(kSmallest, kLargest));
  command->add_option("--out", options->folder, "folder for the files, made if need be")->required();
  command->footer("Example: genu mesh knee.toml --edge 0.5 --out meshes");
  command->callback([options, &exit_code] { exit_code = mesh_scene(*options); });
}

}  // namespace genu::cli
