#include "genu/motion/layer_onset.h"

#include "genu/contact/elastic_layer.h"
#include "genu/motion/tolerances.h"

namespace genu {

LayerOnset::LayerOnset(const JointModel& model) : model_(model) {
  for (const auto& layer : model.layers) {
    watches_.emplace_back(model, layer.body_a, layer.body_b, *layer.a, *layer.b);
    watches_.back().unwatched = kOnsetTravel * layer.search_depth;
  }
}

bool LayerOnset::presses(int layer, const MotionPoint& point) const {
  const auto& l = model_.layers[at(layer)];
  ElasticLayer::Memory memory;
  LayerWrench pressed;
  l.layer->evaluate(point.state.poses[at(l.body_a)], point.state.poses[at(l.body_b)], memory, pressed,
                    point.state.layer_level(at(layer)));
  return pressed.load > 0;
}

std::optional<MotionPoint> LayerOnset::first(const MotionPoint& from, const MotionPoint& to,
                                             const PointAt& point_at) const {
  std::optional<MotionPoint> first;
  for (int k = 0; k < static_cast<int>(model_.layers.size()); ++k) {
    const MotionWatch& watch = watches_[at(k)];
    if (watch.way(from, to) <= watch.unwatched || presses(k, from)) continue;
    MotionPoint free = from, pressed;
    for (bool all = false, found = false; !all && !found;) {
      pressed = to;
      all = true;
      for (int i = 0; i < kMaxOnsetCuts && watch.way(free, pressed) > watch.unwatched; ++i) {
        all = false;
        if (!point_at(0.5 * (free.time + pressed.time), pressed)) return first;
      }
      found = presses(k, pressed);
      if (!found) free = pressed;
    }
    if (!presses(k, pressed)) continue;
    MotionPoint middle;
    while (watch.way(free, pressed) > kOnsetTravel * watch.unwatched) {
      if (!point_at(0.5 * (free.time + pressed.time), middle)) return first;
      (presses(k, middle) ? pressed : free) = middle;
    }
    if (free.time > from.time && (!first || free.time < first->time)) first = free;
  }
  return first;
}

}  // namespace genu
