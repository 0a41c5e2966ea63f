#include "genu/equilibrium/adrift.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/contact/elastic_layer.h"
#include "genu/core/units.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

bool touches(const JointModel& model, ContactField& field, const State& state) {
  for (int pair = 0; pair < static_cast<int>(model.pairs.size()); ++pair)
    if (field.overlap(state, pair) > 0) return true;
  return std::any_of(model.layers.begin(), model.layers.end(), [&](const JointModel::Layer& layer) {
    ElasticLayer::Memory memory;
    LayerWrench pressed;
    layer.layer->evaluate(state.poses[at(layer.body_a)], state.poses[at(layer.body_b)], memory, pressed, 0, nullptr);
    return pressed.load > 0;
  });
}

bool pulls(const JointModel& model, const State& state) {
  return !model.bushings.empty() ||
         std::any_of(model.ligaments.begin(), model.ligaments.end(), [&](const JointModel::Ligament& ligament) {
           return ligament.law.evaluate(ligament.path.length(state.poses)).force != 0;
         });
}

}  // namespace

std::string adrift(const JointModel& model, ContactField& field, const State& start, const State& ended) {
  double farthest = kAdriftSizes * model.scales.size;
  const JointModel::Body* body = nullptr;
  for (std::size_t i = 0; i < std::min(model.bodies.size(), ended.poses.size()); ++i) {
    const double moved = (ended.poses[i].p - start.poses[i].p).norm();
    if (moved > farthest) farthest = moved, body = &model.bodies[i];
  }
  if (body == nullptr || pulls(model, ended) || touches(model, field, ended)) return {};
  return fmt::format(
      "the loads drive {} away: {:.3g} mm from the start nothing touches, and no ligament has a force to hold it",
      body->name, to::kMillimetre * farthest);
}

}  // namespace genu
