#include "genu/results/triangle_pressures.h"

#include <algorithm>

#include "genu/model/unbalanced.h"

namespace genu {

/// Calls visit(layer, side, surface) for each side whose casting surface is a mesh.
template <typename Visit>
void PressureFinder::for_sides(Visit visit) const {
  for (std::size_t k = 0; k < model_.layers.size(); ++k) {
    const auto& sides = model_.layers[k].layer->sides();
    const ContactDef& pair = scene_.layers[k].pair;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const int surface = sides[i].a ? pair.surface_a : pair.surface_b;
      if (scene_.surfaces[genu::at(surface)].shape == SurfaceDef::Shape::mesh) visit(k, i, surface);
    }
  }
}

std::vector<int> PressureFinder::surfaces() const {
  std::vector<int> found;
  for_sides([&](std::size_t, std::size_t, int surface) {
    if (std::find(found.begin(), found.end(), surface) == found.end()) found.push_back(surface);
  });
  return found;
}

std::vector<TrianglePressures> PressureFinder::at(const State& state, const Target& target) {
  std::vector<TrianglePressures> out;
  for (const int surface : surfaces()) out.push_back({surface, {}, {}});
  if (out.empty()) return out;
  const Unbalanced found = unbalanced(model_, state, target, memory_);
  layers_.resize(model_.layers.size());
  for_sides([&](std::size_t k, std::size_t side, int surface) {
    TrianglePressures& here =
        *std::find_if(out.begin(), out.end(), [&](const TrianglePressures& t) { return t.surface == surface; });
    const JointModel::Layer& layer = model_.layers[k];
    const auto note = [&](const LayerPoint& point) {
      const std::size_t cell = genu::at(point.cell);
      if (cell >= here.pressure.size()) {
        here.pressure.resize(cell + 1);
        here.depth.resize(cell + 1);
      }
      here.pressure[cell] = std::max(here.pressure[cell], point.pressure);
      here.depth[cell] = std::max(here.depth[cell], point.depth);
    };
    const int level = k < found.layer_levels.size() ? found.layer_levels[k] : 0;
    layer.layer->visit(state.poses[genu::at(layer.body_a)], state.poses[genu::at(layer.body_b)], side, layers_[k], note,
                       level);
  });
  return out;
}

}  // namespace genu
