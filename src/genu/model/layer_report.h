// Resultants of an elastic layer at a pose, over the whole layer and over each region.
#pragma once

#include <vector>

#include "genu/contact/elastic_layer.h"
#include "genu/model/state.h"

namespace genu {

/// Vectors in the frame of the second surface's body, with its origin of the file.
struct LayerTotals {
  Vec3 force = Vec3::Zero();     ///< N, on that body: the resultant of p n dA
  Vec3 moment = Vec3::Zero();    ///< N m, about its origin
  double area = 0;               ///< m^2 in contact
  double max_pressure = 0;       ///< Pa
  double mean_pressure = 0;      ///< Pa: mean of p over the area
  double max_depth = 0;          ///< m
  double most_used = 0;          ///< maximum of depth / thickness
  Vec3 centre = Vec3::Zero();    ///< m: centre of pressure, mean of the points weighted by p dA; 0 without contact
  Vec3 centre_a = Vec3::Zero();  ///< the same in the frame of the first surface's body
  int points = 0;                ///< number of triangles or nodes in contact
  bool touches() const { return points > 0; }
};

struct LayerReport {
  LayerTotals total;
  std::vector<LayerTotals> regions;
};

/// For layer k of the model. `regions`: conditions in the frame of the second surface's body. With a `twist` (6 for
/// each moving body) damping is included.
LayerReport report_layer(const JointModel& model, const std::vector<RegionDef>& regions, const State& state, int layer,
                         ElasticLayer::Memory& memory, const VecX* twist = nullptr);

}  // namespace genu
