#include "genu/assemble/drawn_meshes.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "genu/assemble/scene_values.h"
#include "genu/assemble/text_places.h"
#include "genu/core/atomic_output.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_care/noise_field.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/scene/toml_document.h"

namespace genu {
namespace {

/// The meshes of a call in a library, as long as it lasts.
class MeshesInLibrary {
 public:
  explicit MeshesInLibrary(std::shared_ptr<MeshLibrary> library) : library_(std::move(library)) {}
  ~MeshesInLibrary() {
    for (const std::string& name : names_) library_->drop(name);
  }
  MeshesInLibrary(const MeshesInLibrary&) = delete;
  MeshesInLibrary& operator=(const MeshesInLibrary&) = delete;

  void put(const std::string& name, const Mesh& mesh) {
    library_->put(name, mesh);
    names_.push_back(name);
  }

 private:
  std::shared_ptr<MeshLibrary> library_;
  std::vector<std::string> names_;
};

/// The surface's name where any file system takes it.
std::string file_name(const SurfaceDef& def, std::size_t k) {
  const bool plain = std::all_of(def.name.begin(), def.name.end(), [](unsigned char c) {
    return (c < 0x80 && std::isalnum(c) != 0) || c == '_' || c == '-';
  });
  return (plain && !def.name.empty() ? def.name : fmt::format("surface-{}", k + 1)) + ".ply";
}

}  // namespace

std::optional<std::vector<DrawnMesh>> draw_meshes(const Prepared& prepared, const std::vector<MeshDraw>& draws,
                                                  Diagnostics& out) {
  std::vector<DrawnMesh> drawn;
  for (const MeshDraw& draw : draws) {
    const SurfaceDef& def = prepared.source.surfaces[draw.surface];
    Diagnostics ignored;  // what there is to say of the mesh was said of the scene
    auto mesh = prepared.meshes->read(def.file, def.file_unit, ignored);
    if (!mesh) {
      out.error(Code::cannot_read, def.file.text(), "cannot be read again");
      return std::nullopt;
    }
    make_winding_consistent(*mesh, mesh_edges(*mesh));  // as is done before it is fitted
    DrawnMesh one{draw.surface, perturbed(*mesh, draw.noise, draw.draw), {}, {}};
    for (Vec3& v : one.mesh.vertices) v /= def.file_unit;
    if (const auto& blend = prepared.notes[draw.surface].blend) {
      if (!def.fit_radius) one.fit_radius = blend->facts().fit_radius / prepared.source.length_unit;
      if (!def.degree) one.degree = blend->facts().degree;
    }
    drawn.push_back(std::move(one));
  }
  return drawn;
}

std::optional<Prepared> prepare_with_meshes(Scene scene, const Prepared& prepared, const std::vector<DrawnMesh>& drawn,
                                            const std::string& label, Diagnostics& out) {
  MeshesInLibrary meshes(prepared.meshes);
  for (const DrawnMesh& one : drawn) {
    SurfaceDef& def = scene.surfaces[one.surface];
    const std::string name = fmt::format("{} of {}", file_name(def, one.surface), label);
    meshes.put(name, one.mesh);
    def.file.paths = {name};
    def.file.where.resize(1);
    if (one.fit_radius) def.fit_radius = *one.fit_radius * scene.length_unit;
    if (one.degree) def.degree = one.degree;
  }
  return prepare(std::move(scene), prepared.meshes, out);
}

void write_scene_with_meshes(const Prepared& prepared, const std::vector<DrawnMesh>& drawn, const std::string& folder,
                             Diagnostics& out) {
  SceneTables as_it_is = prepared.source;
  as_it_is.changed = {};  // options say it
  const std::string text = with_values(as_it_is.file, as_it_is, {}, folder, out);
  const auto document = parse_toml(text, as_it_is.file, out);
  const TomlNode* surfaces = document ? document->member("surface") : nullptr;
  if (out.has_errors() || surfaces == nullptr) return;
  TextPlaces places(text);
  const std::filesystem::path into = folder;
  for (const DrawnMesh& one : drawn) {
    const SurfaceDef& def = as_it_is.surfaces[one.surface];
    const std::string name = file_name(def, one.surface);
    const TomlNode* table = surfaces->member(def.name.c_str());
    const TomlNode* file = table != nullptr ? table->member("file") : nullptr;
    bool good = file != nullptr && places.text_or_list(file->where, '"' + name + '"');
    const auto add_line = [&](const std::string& line) { good = good && places.line_below(table->key_where, line); };
    std::string lines;
    if (one.fit_radius) lines += fmt::format("fit_radius = {}", *one.fit_radius);
    if (one.degree) lines += fmt::format("{}degree = {}", lines.empty() ? "" : "\n", *one.degree);
    if (!lines.empty()) add_line(lines);
    if (!good)
      out.add(error_at(
          {as_it_is.file, def.where}, Code::wrong_form, "surface." + def.name, {},
          "cannot be written with another mesh: give the table a header of its own, [surface." + def.name + "]"));
    const std::string error =
        write_ply(one.mesh, (into / name).string(), 1, "genu sweep: a mesh measured another time");
    if (!error.empty()) out.error(Code::cannot_write, {}, error);
  }
  const std::string error = write_file_atomically(into / "scene.toml", places.text());
  if (!error.empty()) out.error(Code::cannot_write, {}, error);
}

}  // namespace genu
