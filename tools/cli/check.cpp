// genu check knee.toml
//   1. read the scene: every error at once, with line and column
//   2. read and check its meshes, build the surfaces, look at the start
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "changes.h"
#include "commands.h"
#include "genu/mesh_care/mesh_crossings.h"
#include "genu/study/anatomy_doubts.h"
#include "genu/study/run_scene.h"

namespace genu::cli {
namespace {

void describe_surface(const SurfaceNote& note, const Surface& surface) {
  fmt::print("  {}: {}\n", note.name, note.text);
  if (!note.mesh) return;
  const MeshReport& m = *note.mesh;
  const auto line = [](const char* what, const std::string& value) { fmt::print("    {:<22}{}\n", what, value); };
  line("vertices, triangles", fmt::format("{}, {}", m.vertices, m.triangles));
  line("sheets, holes+borders", fmt::format("{}, {}", m.components, m.boundary_loops));
  line("edges 5/50/95 %", fmt::format("{:.3f} / {:.3f} / {:.3f} mm", 1e3 * m.edge_length[1], 1e3 * m.edge_length[2],
                                      1e3 * m.edge_length[3]));
  line("box diagonal", fmt::format("{:.1f} mm", 1e3 * m.box.diagonal()));
  line("non-manifold edges", fmt::format("{}", m.non_manifold_edges));
  line("flipped triangles", fmt::format("{}{}", m.flipped, m.orientable ? "" : " (no winding agrees everywhere)"));
  line("degenerate, slivers", fmt::format("{}, {}", m.degenerate, m.slivers));
  line("self-intersections", fmt::format("{}", crossing_triangles(surface.triangles(0, Vec3::Zero(), 0)).size()));
}

int check(const SceneSource& scene) {
  Diagnostics diagnostics;
  const auto prepared = prepare(scene, diagnostics);
  bool good = prepared.has_value();
  if (good) {
    ContactField field(prepared->model);
    good = check_start(*prepared, field, diagnostics);
    warn_about_anatomy(*prepared, diagnostics);
    for (const auto& body : prepared->bodies) fmt::print("  {}\n", to_text(body));
    for (std::size_t i = 0; i < prepared->notes.size(); ++i)
      describe_surface(prepared->notes[i], *prepared->surfaces[i]);
  }
  print(diagnostics);
  if (good) fmt::print("{}: no errors\n", scene.path);
  return good ? kExitOk : kExitRefused;
}

}  // namespace

void add_check(CLI::App& command, int& exit_code) {
  auto scene = std::make_shared<SceneSource>("");
  command.add_option("SCENE", scene->path, "scene file (TOML)")->required();
  add_changes(command, scene->changes);
  command.footer("Example: genu check knee.toml");
  command.callback([scene, &exit_code] { exit_code = check(*scene); });
}

}  // namespace genu::cli
