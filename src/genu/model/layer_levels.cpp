#include "genu/model/layer_levels.h"

#include <algorithm>

#include "genu/model/tolerances.h"

namespace genu {

bool raise_layer_levels(const JointModel& model, const Linearization& here, State& state) {
  bool raised = false;
  for (std::size_t k = 0; k < model.layers.size(); ++k) {
    const auto& layer = model.layers[k];
    const double allowed = layer.tolerance * std::max(here.layer_loads[k], kMinLayerLoadShare * model.scales.force);
    if (state.layer_level(k) >= layer.most_level || !(here.layer_errors[k] > allowed)) continue;
    state.layer_levels.resize(model.layers.size(), 0);
    ++state.layer_levels[k];
    raised = true;
  }
  return raised;
}

}  // namespace genu
