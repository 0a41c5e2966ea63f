#include "genu/model/build_layer.h"

#include <algorithm>

#include "genu/contact/triangle_layer.h"

namespace genu {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double kEdge = 0.01;  // of the smaller surface
constexpr double kReach = 3;    // of the larger one, or of the characteristic length: what is used of endless shapes

/// Triangles of one of the two surfaces, in its body.
class Facets {
 public:
  Facets(const JointModel& model, const JointModel::Layer& between) : model_(model) {
    const double coarse = model.scales.length;
    double smaller = 2 * coarse, larger = 0;
    for (const auto& surface : {between.a, between.b}) {
      if (surface->is_unbounded()) continue;
      const double size = box_diagonal(*surface, coarse);
      smaller = larger == 0 ? size : std::min(smaller, size);
      larger = std::max(larger, size);
    }
    edge_ = kEdge * smaller;
    reach_ = kReach * std::max(larger, coarse);
  }

  Mesh of(const Surface& surface, int body) const {
    return surface.triangles(edge_, model_.reference_poses[at(body)].inverse() * joint_centre(model_), reach_);
  }

 private:
  const JointModel& model_;
  double edge_ = 0, reach_ = 0;
};

}  // namespace

std::shared_ptr<const ElasticLayer> build_layer(const JointModel& model, const LayerDef& def,
                                                const JointModel::Layer& between) {
  const Facets facets(model, between);
  const Mesh a = facets.of(*between.a, between.body_a), b = facets.of(*between.b, between.body_b);
  const bool from_a = def.cast_from == def.pair.surface_a;
  LayerLaw law;
  law.kind = def.law == LayerDef::Law::linear ? LayerLaw::Kind::linear : LayerLaw::Kind::logarithmic;
  law.confined_modulus = confined_modulus(def.modulus, def.poisson);
  const auto target = std::make_shared<const TriangleTree>(from_a ? b : a);
  const LayerThickness thickness{def.thickness, {}, {}};
  return std::make_shared<const ElasticLayer>(std::vector<ElasticLayer::Side>{
      {from_a, 1.0, std::make_shared<TriangleLayer>(from_a ? a : b, target, def.search_depth, law, thickness)}});
}

}  // namespace genu
