// The surfaces of elastic layers that cast, to be looked at: one visit for all who show what they carry.
#pragma once

#include <functional>
#include <vector>

#include "genu/model/layer_report.h"
#include "genu/scene/scene.h"

namespace genu {

struct CastingSide {
  std::size_t layer = 0;  ///< index into JointModel::layers
  std::size_t side = 0;   ///< index into ElasticLayer::sides()
  int surface = -1;       ///< index into Scene::surfaces
  int body = -1;          ///< of the surface: index into JointModel::bodies
};

/// Of every layer in turn.
std::vector<CastingSide> casting_sides(const PlacedScene& scene, const JointModel& model);

/// Visits the points of a side that carry pressure. `poses`: of all bodies, in the world; `memories`: one for each
/// layer, `level`: of its quadrature (LayerQuadrature).
void visit_side(const JointModel& model, const CastingSide& side, const std::vector<Pose>& poses,
                std::vector<ElasticLayer::Memory>& memories, int level,
                const std::function<void(const LayerPoint&)>& visit);

}  // namespace genu
