#include "genu/sweep/write_sample.h"

#include <filesystem>

#include "genu/assemble/drawn_meshes.h"
#include "genu/core/atomic_output.h"
#include "genu/store/checkpoint.h"

namespace genu {

std::optional<SceneSource> write_sample(const Sweep& sweep, const SweepCase& in, std::uint64_t sample,
                                        const std::string& folder, Diagnostics& out) {
  SceneSource source = source_of_sample(sweep, in, sample);
  const std::vector<MeshDraw> draws = mesh_draws(in, sweep.design.draws(sample));
  if (draws.empty()) return source;
  const auto drawn = draw_meshes(in.prepared, draws, out);
  if (!drawn) return std::nullopt;
  const std::string target = beside(folder, ".scene");
  StagedFolder staged("sample scene");
  if (const auto refused = staged.open(target)) {
    out.error(refused->code, {}, refused->text);
    return std::nullopt;
  }
  write_scene_with_meshes(in.prepared, *drawn, staged.path().string(), out);
  if (out.has_errors()) return std::nullopt;
  if (const std::string error = staged.commit(); !error.empty()) {
    out.error(Code::cannot_write, {}, error);
    return std::nullopt;
  }
  source.path = (std::filesystem::path(target) / "scene.toml").string();
  return source;
}

}  // namespace genu
