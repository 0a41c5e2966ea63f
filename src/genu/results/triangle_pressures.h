// What elastic layers carry, triangle by triangle of the meshes that cast: to be looked at.
#pragma once

#include <vector>

#include "genu/model/linearization.h"
#include "genu/results/casting_sides.h"

namespace genu {

/// Of one surface's mesh at one pose: a number for each triangle, 0 where nothing presses.
struct TrianglePressures {
  int surface = -1;                     ///< index into Scene::surfaces
  std::vector<double> pressure, depth;  ///< Pa, m: the largest at any point of the triangle
};

/// Remembers what makes the next pose faster. `model` must outlive it.
class PressureFinder {
 public:
  PressureFinder(const PlacedScene& scene, const JointModel& model);

  /// Surfaces that are meshes and cast, as scene and model have them: the same at every pose.
  std::vector<int> surfaces() const;

  /// Of each of surfaces(). What damping adds is left out. `state` and `target` as unbalanced() takes them.
  std::vector<TrianglePressures> at(const State& state, const Target& target);

 private:
  const JointModel& model_;
  std::vector<CastingSide> sides_;  // those that are meshes
  Linearization memory_;
  std::vector<ElasticLayer::Memory> layers_;
};

}  // namespace genu
