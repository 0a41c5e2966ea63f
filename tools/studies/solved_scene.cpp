#include "studies/solved_scene.h"

namespace genu::studies {

std::vector<double> SolvedScene::column(const std::string& name) const {
  std::vector<double> out;
  for (std::size_t row = 0; row < solution.poses.rows(); ++row) out.push_back(solution.poses.number(row, name));
  return out;
}

bool SolvedScene::all_stable() const {
  for (const PoseRecord& r : solution.records)
    if (!r.point.solved() || r.point.stability.verdict != Stability::Verdict::stable) return false;
  return !solution.records.empty();
}

namespace {

std::unique_ptr<SolvedScene> solve_prepared(std::optional<Prepared> prepared, Diagnostics& out) {
  if (!prepared) return nullptr;
  auto solved = std::make_unique<SolvedScene>(SolvedScene{std::move(*prepared), {}});
  ContactField field(solved->prepared.model);
  if (!check_start(solved->prepared, field, out)) return nullptr;
  solved->solution = solve(solved->prepared, field, {});
  return solved;
}

}  // namespace

std::unique_ptr<SolvedScene> solve_scene(const std::string& file, Diagnostics& out) {
  return solve_prepared(prepare(file, out), out);
}

std::unique_ptr<SolvedScene> solve_scene(const Scene& scene, Diagnostics& out, std::shared_ptr<MeshLibrary> meshes) {
  return solve_prepared(prepare(scene, std::move(meshes), out), out);
}

}  // namespace genu::studies
