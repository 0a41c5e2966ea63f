#include "genu/results/casting_sides.h"

namespace genu {

std::vector<CastingSide> casting_sides(const PlacedScene& scene, const JointModel& model) {
  std::vector<CastingSide> out;
  for (std::size_t k = 0; k < model.layers.size(); ++k) {
    const JointModel::Layer& layer = model.layers[k];
    const ContactDef& pair = scene.layers[k].pair;
    const auto& sides = layer.layer->sides();
    for (std::size_t i = 0; i < sides.size(); ++i)
      out.push_back({k, i, sides[i].a ? pair.surface_a : pair.surface_b, sides[i].a ? layer.body_a : layer.body_b});
  }
  return out;
}

void visit_side(const JointModel& model, const CastingSide& side, const std::vector<Pose>& poses,
                std::vector<ElasticLayer::Memory>& memories, int level,
                const std::function<void(const LayerPoint&)>& visit) {
  memories.resize(model.layers.size());
  const JointModel::Layer& layer = model.layers[side.layer];
  layer.layer->visit(poses[at(layer.body_a)], poses[at(layer.body_b)], side.side, memories[side.layer], visit, level);
}

}  // namespace genu
