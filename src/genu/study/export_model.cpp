#include "genu/study/export_model.h"

#include <filesystem>
#include <limits>

#include "genu/assemble/prepare.h"
#include "genu/core/atomic_output.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/store/opensim_columns.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGeometry = "Geometry";  // where OpenSim looks for the meshes of a model

/// The scene with the origins of its file, and what follows from the meshes of its solids.
Scene with_masses(const Prepared& prepared) {
  Scene scene = prepared.source;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodyDef& known = prepared.scene.bodies[b];
    if (!scene.bodies[b].solid) continue;
    scene.bodies[b].mass = known.mass;
    scene.bodies[b].inertia = known.inertia;
    scene.bodies[b].centre_of_mass = known.centre_of_mass + prepared.scene.origins[b];
  }
  return scene;
}

/// Surfaces of elastic layers that are meshes.
std::vector<bool> layered(const Scene& scene) {
  std::vector<bool> found(scene.surfaces.size());
  for (const LayerDef& l : scene.layers)
    for (const int k : {l.pair.surface_a, l.pair.surface_b})
      found[at(k)] = scene.surfaces[at(k)].shape == SurfaceDef::Shape::mesh;
  return found;
}

osim::ExportRequest request_of(const Prepared& prepared, const OpenSimNames& names) {
  osim::ExportRequest request;
  request.name = prepared.source.title.empty() ? "genu" : prepared.source.title;
  request.coordinates = names;
  for (const auto& l : prepared.model.ligaments) request.slack_lengths.push_back(l.law.slack_length());
  for (const auto& l : prepared.model.layers) request.search_depths.push_back(l.search_depth);
  const std::vector<bool> used = layered(prepared.source);
  for (std::size_t k = 0; k < used.size(); ++k) {
    const SurfaceDef& s = prepared.source.surfaces[k];
    const bool bone = used[k] && s.thickness && s.thickness->measured;
    request.meshes.push_back(used[k] ? s.name + ".obj" : std::string());
    request.bones.push_back(bone ? s.name + "_bone.obj" : std::string());
  }
  return request;
}

/// The mesh as it is used, in its body's frame of the file.
Mesh mesh_in_body(const Prepared& prepared, std::size_t surface) {
  Mesh mesh = prepared.surfaces[surface]->triangles(0, Vec3::Zero(), 0);
  const Vec3& origin = prepared.scene.origins[at(prepared.source.surfaces[surface].body)];
  for (Vec3& v : mesh.vertices) v += origin;
  return mesh;
}

std::optional<Mesh> bone_in_body(const Prepared& prepared, const SurfaceDef& s, Diagnostics& out) {
  auto mesh = prepared.meshes->read(s.thickness->bone, s.thickness->bone_unit, out);
  if (mesh)
    for (Vec3& v : mesh->vertices) v = s.placement * v;
  return mesh;
}

/// Empty, or why a file cannot be written.
std::string write_meshes(const Prepared& prepared, const osim::ExportRequest& request, const fs::path& folder,
                         Diagnostics& out, int& files) {
  std::error_code failed;
  for (std::size_t k = 0; k < request.meshes.size(); ++k) {
    if (request.meshes[k].empty()) continue;
    const SurfaceDef& s = prepared.source.surfaces[k];
    if (files++ == 0) fs::create_directory(folder, failed);
    std::string error = write_obj(mesh_in_body(prepared, k), folder / request.meshes[k], 1, "surface " + s.name);
    if (error.empty() && !request.bones[k].empty()) {
      const auto bone = bone_in_body(prepared, s, out);
      if (!bone) return {};
      ++files;
      error = write_obj(*bone, folder / request.bones[k], 1, "bone under " + s.name);
    }
    if (!error.empty()) return error;
  }
  return {};
}

std::string write_files(const Prepared& prepared, const osim::ExportRequest& request, const fs::path& folder,
                        ExportReport& report, Diagnostics& out) {
  const osim::ExportedModel& model = report.model;
  std::string error = write_file_atomically(folder / "model.osim", model.text);
  if (error.empty()) error = write_file_atomically(folder / "export.csv", model.table);
  if (error.empty() && !model.forces.empty()) error = write_file_atomically(folder / "forces.sto", model.forces);
  return error.empty() ? write_meshes(prepared, request, folder / kGeometry, out, report.meshes) : error;
}

}  // namespace

std::optional<ExportReport> export_model(const ModelExport& asked, Diagnostics& out) {
  const auto prepared = prepare(asked.source, out);
  if (!prepared) return std::nullopt;
  OpenSimNameOptions how;
  how.columns = asked.columns;
  how.side = asked.side;
  const auto names = opensim_column_names(prepared->source, how, out);
  if (!names) return std::nullopt;
  const osim::ExportRequest request = request_of(*prepared, *names);
  ExportReport report;
  report.model = osim::export_scene(with_masses(*prepared), request);
  report.file = (fs::path(asked.folder) / "model.osim").string();
  StagedFolder staged("");  // it will be edited: never to be replaced
  if (const auto refused = staged.open(asked.folder)) {
    out.error(refused->code, {}, refused->text);
    return std::nullopt;
  }
  std::string error = write_files(*prepared, request, staged.path(), report, out);
  if (out.has_errors()) return std::nullopt;
  if (error.empty()) error = staged.commit();
  report.written = error.empty();
  if (!report.written) out.error(Code::cannot_write, {}, error);
  return report;
}

}  // namespace genu
