// genu mesh knee.toml --edge 1 --out meshes
//   1. read the scene, the surfaces.toml that `genu fit` writes, or a file of solids
//   2. cut each surface that has a formula and each solid (or only those named) into triangles; with --thickness close
//      open ones
//   3. write DIR/<surface>.stl, .ply or .obj, in the frame of the surface's body or of the solid
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
#include "genu/assemble/build_solid.h"
#include "genu/assemble/build_surface.h"
#include "genu/core/diagnostics.h"
#include "genu/core/length_units.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/scene/reader.h"
#include "genu/shape_fit/solid_mesh.h"
#include "genu/shape_fit/thicken.h"
#include "genu/surface/tessellate.h"
#include "print_error.h"

namespace genu::cli {
namespace {

constexpr double kReach = 0.05;                     // m
constexpr double kSmallest = 1e-6, kLargest = 1e6;  // of lengths, in the unit of the command
const std::string kTitle = "genu mesh: ";           // of every file, by which it is known again

struct MeshOptions {
  std::string scene, folder, unit = "mm", format = "stl";
  std::vector<std::string> surfaces;
  double edge = 0, reach = 0, thickness = 0;  ///< in `unit`
};

/// What a surface or a solid becomes.
struct Meshed {
  std::string name;
  Mesh mesh;
};

bool asked_for(const std::string& name, const MeshOptions& options) {
  const auto& names = options.surfaces;
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// Says in `out` which names cannot be meshed.
void check_names(const Scene& scene, const MeshOptions& options, Diagnostics& out) {
  std::string known = "known:";
  for (const SurfaceDef& s : scene.surfaces) known += " " + s.name;
  for (const SolidDef& s : scene.solids) known += " " + s.name;
  const auto named = [](const std::string& name) { return [&name](const auto& def) { return def.name == name; }; };
  for (const std::string& name : options.surfaces) {
    const auto surface = std::find_if(scene.surfaces.begin(), scene.surfaces.end(), named(name));
    const bool solid = std::any_of(scene.solids.begin(), scene.solids.end(), named(name));
    if (surface != scene.surfaces.end() && solid)
      out.error(Code::duplicate, scene.file,
                "\"" + name + "\" is both a surface and a solid: give one of them another name");
    else if (surface == scene.surfaces.end() && !solid)
      out.error(Code::unknown_name, scene.file, "there is no surface \"" + name + "\"; " + known);
    else if (!solid && surface->shape == SurfaceDef::Shape::mesh)
      out.error(Code::not_applicable, scene.file, "surface \"" + name + "\" is a mesh already");
  }
  const bool formula = std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                                   [](const SurfaceDef& s) { return s.shape != SurfaceDef::Shape::mesh; });
  if (!formula && scene.solids.empty())
    out.error(Code::not_applicable, scene.file, "has no surface with a formula and no solid");
}

/// Empty, with what is wrong in `out`, where not all of them can be meshed.
std::vector<Meshed> mesh_surfaces(const Scene& scene, const MeshOptions& options, double unit, Diagnostics& out) {
  std::vector<const SurfaceDef*> chosen;
  std::vector<std::shared_ptr<const Surface>> surfaces;
  for (const SurfaceDef& def : scene.surfaces) {
    if (def.shape == SurfaceDef::Shape::mesh || !asked_for(def.name, options)) continue;
    chosen.push_back(&def);
    surfaces.push_back(within_patch(make_analytic_surface(def), def));
    if (!surfaces.back())
      out.error(Code::no_surface, scene.file, "surface \"" + def.name + "\" has sizes or a patch that make no surface");
  }
  std::vector<Meshed> meshes;
  if (out.has_errors()) return meshes;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const double reach = options.reach > 0 ? options.reach * unit : kReach;
    Mesh mesh = surfaces[k]->triangles(options.edge * unit, chosen[k]->placement.p, reach);
    if (options.thickness > 0) {
      std::string why;
      mesh = thicken(mesh, *surfaces[k], options.thickness * unit, options.edge * unit, why);
      if (!why.empty()) out.error(Code::no_surface, scene.file, "surface \"" + chosen[k]->name + "\" " + why);
    }
    meshes.push_back({chosen[k]->name, std::move(mesh)});
  }
  return meshes;
}

void mesh_solids(const Scene& scene, const MeshOptions& options, double unit, std::vector<Meshed>& meshes,
                 Diagnostics& out) {
  for (const SolidDef& def : scene.solids) {
    if (!asked_for(def.name, options)) continue;
    std::string why;
    meshes.push_back({def.name, solid_mesh(make_solid(def), options.edge * unit, why)});
    if (!why.empty()) out.add(error_at({scene.file, def.where}, Code::no_surface, "solid." + def.name, {}, why));
  }
}

/// A file of the same name that someone else wrote, as the mesh a surface was measured on, is not replaced.
void refuse_foreign(const std::string& path, Diagnostics& out) {
  std::error_code code;
  if (!std::filesystem::exists(std::filesystem::symlink_status(path, code)) || has_title(path, kTitle)) return;
  out.error(Code::would_overwrite, path,
            "is there already and was not written by genu mesh: it will not be replaced; choose another folder");
}

void describe_file(const std::string& path, const Mesh& mesh, double wanted, const MeshOptions& options, double unit) {
  const MeshReport report = check_mesh(mesh);
  fmt::print("{}: {} vertices, {} triangles, edges {:.3g} .. {:.3g} .. {:.3g} {}, smallest angle {:.1f} deg\n", path,
             report.vertices, report.triangles, report.edge_length[0] / unit, report.edge_length[2] / unit,
             report.edge_length[4] / unit, options.unit, smallest_angle(mesh) * 180 / std::numbers::pi);
  if (report.edge_length[2] > 1.2 * wanted) {
    print_error("{}: warning: coarser than --edge {}: a surface of its kind gets no more than about {} triangles\n",
                printable(path), options.edge, report.triangles);
  }
}

int mesh_scene(const MeshOptions& options) {
  const double unit = metres_in(options.unit).value_or(units::kMillimetre);
  Diagnostics problems;
  const std::optional<Scene> scene = read_surface_file(options.scene, problems);
  if (!scene) return refuse(problems);
  check_names(*scene, options, problems);
  if (problems.has_errors()) return refuse(problems);
  std::vector<Meshed> meshes = mesh_surfaces(*scene, options, unit, problems);
  mesh_solids(*scene, options, unit, meshes, problems);
  if (problems.has_errors()) return refuse(problems);

  const auto path_of = [&](const Meshed& m) { return options.folder + "/" + m.name + "." + options.format; };
  for (const Meshed& m : meshes) refuse_foreign(path_of(m), problems);
  if (options.folder.empty()) problems.error(Code::no_output_folder, "--out", "names no folder");
  if (problems.has_errors()) return refuse(problems);
  std::error_code failure;
  std::filesystem::create_directories(options.folder, failure);
  if (failure) {
    problems.error(Code::cannot_write, options.folder, "cannot be made a folder: " + failure.message());
    return refuse(problems);
  }
  for (const Meshed& m : meshes) {
    const std::string path = path_of(m);
    const std::string title = fmt::format("{}{}, edge {} {}", kTitle, m.name, options.edge, options.unit);
    if (const std::string error = write_mesh(m.mesh, path, unit, title); !error.empty()) {
      print_error("{}\n", error);
      return kFailed;
    }
    describe_file(path, m.mesh, options.edge * unit, options, unit);
  }
  return kOk;
}

}  // namespace

void add_mesh(CLI::App& command, int& exit_code) {
  auto options = std::make_shared<MeshOptions>();
  command.add_option("SCENE", options->scene, "scene file, the surfaces.toml of genu fit, or a file of solids")
      ->required();
  command.add_option("SURFACE", options->surfaces,
                     "surfaces and solids to mesh; all that have a formula where none is named");
  command
      .add_option("--edge", options->edge, "length of the triangles' edges; shorter where the surface bends strongly")
      ->check(number_within(kSmallest, kLargest))
      ->required();
  command.add_option("--unit", options->unit, "unit of --edge, --reach and the files")
      ->check(CLI::IsMember(length_unit_names()))
      ->capture_default_str();
  command.add_option("--reach", options->reach, "how far planes, cylinders and polynomials go; 50 mm where not given")
      ->check(number_within(kSmallest, kLargest));
  command.add_option("--format", options->format, "of the files: stl is binary float32, ply binary float64, obj text")
      ->check(CLI::IsMember({"stl", "ply", "obj"}))
      ->capture_default_str();
  command
      .add_option("--thickness", options->thickness,
                  "closes open surfaces: watertight solids so thick, behind the surface; closed ones stay")
      ->check(number_within(kSmallest, kLargest));
  command.add_option("-o,--out", options->folder, "folder for the files, made if need be")->required();
  command.footer("Example: genu mesh knee.toml --edge 0.5 --out meshes");
  command.callback([options, &exit_code] { exit_code = mesh_scene(*options); });
}

}  // namespace genu::cli
