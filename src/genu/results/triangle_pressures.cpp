#include "genu/results/triangle_pressures.h"

#include <algorithm>

#include "genu/model/unbalanced.h"

namespace genu {

PressureFinder::PressureFinder(const PlacedScene& scene, const JointModel& model)
    : model_(model), sides_(casting_sides(scene, model)) {
  std::erase_if(sides_, [&](const CastingSide& side) {
    return scene.surfaces[genu::at(side.surface)].shape != SurfaceDef::Shape::mesh;
  });
}

std::vector<int> PressureFinder::surfaces() const {
  std::vector<int> found;
  for (const CastingSide& side : sides_)
    if (std::find(found.begin(), found.end(), side.surface) == found.end()) found.push_back(side.surface);
  return found;
}

std::vector<TrianglePressures> PressureFinder::at(const State& state, const Target& target) {
  std::vector<TrianglePressures> out;
  for (const int surface : surfaces()) out.push_back({surface, {}, {}});
  if (out.empty()) return out;
  const Unbalanced found = unbalanced(model_, state, target, memory_);
  for (const CastingSide& side : sides_) {
    TrianglePressures& here =
        *std::find_if(out.begin(), out.end(), [&](const TrianglePressures& t) { return t.surface == side.surface; });
    const auto note = [&](const LayerPoint& point) {
      const std::size_t cell = genu::at(point.cell);
      if (cell >= here.pressure.size()) {
        here.pressure.resize(cell + 1);
        here.depth.resize(cell + 1);
      }
      here.pressure[cell] = std::max(here.pressure[cell], point.pressure);
      here.depth[cell] = std::max(here.depth[cell], point.depth);
    };
    const int level = side.layer < found.layer_levels.size() ? found.layer_levels[side.layer] : 0;
    visit_side(model_, side, state.poses, layers_, level, note);
  }
  return out;
}

}  // namespace genu
