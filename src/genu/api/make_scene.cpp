// Scenes from files, from texts and from nothing.
#include <filesystem>

#include <fmt/format.h>

#include "genu/api/mesh_of.h"
#include "genu/api/scene_inside.h"
#include "genu/assemble/prepare.h"
#include "genu/new_scene/new_scene.h"
#include "genu/new_scene/new_scene_text.h"
#include "genu/scene/reader.h"
#include "genu/scene/words.h"

namespace genu::api {
namespace {

namespace fs = std::filesystem;

/// Puts each mesh in the place of the files that the scene opens under its name.
void put_meshes(const genu::Scene& scene, const std::map<std::string, Triangles>& meshes, MeshLibrary& library) {
  const std::vector<std::string> files = mesh_files(scene);
  for (const auto& [name, triangles] : meshes) {
    const Mesh mesh = mesh_of(name, triangles);
    bool used = false;
    const std::string in_folder = (fs::path(scene.file).parent_path() / name).lexically_normal().string();
    for (const std::string& file : files) {
      if (file != name && fs::path(file).lexically_normal().string() != in_folder) continue;
      library.put(file, mesh);
      used = true;
    }
    if (!used)
      refuse(Code::unknown_name, "meshes", with_quotes(name), "is no file of this scene" + did_you_mean(name, files));
  }
}

MeshesAtHand names_of_meshes(const std::map<std::string, Triangles>& meshes) {
  MeshesAtHand names;
  for (const auto& mesh : meshes) names.push_back(mesh.first);
  return names;
}

Scene scene_of(std::optional<genu::Scene> read, const std::map<std::string, Triangles>& meshes,
               std::shared_ptr<MeshLibrary> library, const Diagnostics& out) {
  check(out);
  put_meshes(*read, meshes, *library);
  return Scene(std::make_unique<Scene::Inside>(std::move(*read), std::move(library)));
}

}  // namespace

Scene load(const std::string& file, const std::map<std::string, Triangles>& meshes) {
  auto library = std::make_shared<MeshLibrary>();
  Diagnostics out;
  auto read = read_scene(file, library->files(), out, names_of_meshes(meshes));
  return scene_of(std::move(read), meshes, std::move(library), out);
}

Scene parse(const std::string& text, const std::string& file, const std::map<std::string, Triangles>& meshes) {
  Diagnostics out;
  auto read = parse_scene(text, file, out, names_of_meshes(meshes));
  auto library = std::make_shared<MeshLibrary>();
  library->files().put(file, text);
  return scene_of(std::move(read), meshes, std::move(library), out);
}

Scene make(const NewScene& asked) {
  if (asked.kind != "analytic" && asked.kind != "motion" && asked.kind != "stl")
    refuse(Code::unknown_name, "kind", with_quotes(asked.kind), "must be one of \"analytic\", \"motion\", \"stl\"");
  if (asked.folder.empty()) {
    if (asked.kind == "stl") refuse(Code::no_scene_name, "folder", {}, "is needed for a scene of meshes");
    const std::string text = asked.kind == "motion" ? motion_scene_text() : analytic_scene_text();
    return parse(filled_in(text, {{"title", "knee"}, {"name", "knee"}, {"file", "knee.toml"}}), "knee.toml");
  }
  genu::NewScene how;
  how.kind = asked.kind == "stl"      ? genu::NewScene::Kind::stl
             : asked.kind == "motion" ? genu::NewScene::Kind::motion
                                      : genu::NewScene::Kind::analytic;
  how.folder = asked.folder;
  how.femur_any.paths = asked.femur;
  how.tibia_any.paths = asked.tibia;
  how.patella_any.paths = asked.patella;
  how.fibula.paths = asked.fibula;
  how.unit = asked.unit;
  how.proximal = asked.proximal;
  how.anterior = asked.anterior;
  if (!asked.side.empty() && asked.side != "left" && asked.side != "right")
    refuse(Code::unknown_name, "side", with_quotes(asked.side), "must be \"left\" or \"right\"");
  if (!asked.side.empty()) how.left = asked.side == "left";
  Diagnostics out;
  const auto written = write_new_scene(how, out);
  check(out);
  return load(written->file);
}

}  // namespace genu::api
