// What elastic layers carry, triangle by triangle of the meshes that cast: to be looked at.
#pragma once

#include <vector>

#include "genu/model/layer_report.h"
#include "genu/model/linearization.h"
#include "genu/scene/scene.h"

namespace genu {

/// Of one surface's mesh at one pose: a number for each triangle, 0 where nothing presses.
struct TrianglePressures {
  int surface = -1;                     ///< index into Scene::surfaces
  std::vector<double> pressure, depth;  ///< Pa, m: the largest at any point of the triangle
};

/// Remembers what makes the next pose faster. `scene` and `model` must outlive it.
class PressureFinder {
 public:
  PressureFinder(const PlacedScene& scene, const JointModel& model) : scene_(scene), model_(model) {}

  /// Surfaces that are meshes and cast, as scene and model have them: the same at every pose.
  std::vector<int> surfaces() const;

  /// Of each of surfaces(). What damping adds is left out. `state` and `target` as unbalanced() takes them.
  std::vector<TrianglePressures> at(const State& state, const Target& target);

 private:
  template <typename Visit>
  void for_sides(Visit visit) const;

  const PlacedScene& scene_;
  const JointModel& model_;
  Linearization memory_;
  std::vector<ElasticLayer::Memory> layers_;
};

}  // namespace genu
