#include "genu/model/layer_levels.h"

#include <algorithm>

#include "genu/model/tolerances.h"

namespace genu {

double allowed_error(const JointModel& model, std::size_t k, double load) {
  return model.layers[k].tolerance * std::max(load, kMinLayerLoadShare * model.scales.force);
}

bool raise_layer_levels(const JointModel& model, const Linearization& here, State& state) {
  bool raised = false;
  for (std::size_t k = 0; k < model.layers.size(); ++k) {
    const auto& layer = model.layers[k];
    const double allowed = allowed_error(model, k, here.layer_loads[k]);
    if (state.layer_level(k) >= layer.most_level || !(here.layer_errors[k] > allowed)) continue;
    state.layer_levels.resize(model.layers.size(), 0);
    ++state.layer_levels[k];
    raised = true;
  }
  return raised;
}

}  // namespace genu
