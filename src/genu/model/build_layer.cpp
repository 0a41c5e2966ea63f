#include "genu/model/build_layer.h"

#include <algorithm>

#include "genu/contact/elastic_layer.h"
#include "genu/contact/smooth_layer.h"
#include "genu/contact/tolerances.h"
#include "genu/contact/triangle_layer.h"
#include "genu/model/measured_thickness.h"
#include "genu/model/tolerances.h"

namespace genu {
namespace {

/// Triangles of one of the two surfaces, in its body.
class Facets {
 public:
  Facets(const JointModel& model, const JointModel::Layer& between, double edge) : model_(model) {
    const double coarse = model.scales.length;
    double smaller = 2 * coarse, larger = 0;
    for (const auto& surface : {between.a, between.b}) {
      if (surface->is_unbounded()) continue;
      const double size = box_diagonal(*surface, coarse);
      smaller = larger == 0 ? size : std::min(smaller, size);
      larger = std::max(larger, size);
    }
    edge_ = edge * smaller;
    reach_ = kLayerReach * std::max(larger, coarse);
  }

  Mesh of(const Surface& surface, int body) const {
    return surface.triangles(edge_, model_.reference_poses[at(body)].inverse() * joint_centre(model_), reach_);
  }

 private:
  const JointModel& model_;
  double edge_ = 0, reach_ = 0;
};

LayerLaw law_of(const LayerDef& def) {
  LayerLaw law;
  law.kind = def.law == LayerDef::Law::linear ? LayerLaw::Kind::linear : LayerLaw::Kind::logarithmic;
  law.confined_modulus = confined_modulus(def.modulus, def.poisson);
  return law;
}

using SharedThickness = std::shared_ptr<const ThicknessField>;

using Tree = std::shared_ptr<const TriangleTree>;

std::shared_ptr<const Buried> buried_deeper(const Mesh& a, const Tree& tree_a, const Mesh& b, const Tree& tree_b,
                                            const JointModel::Layer& between) {
  return std::make_shared<const Buried>(Buried::Triangles{&a, tree_a}, Buried::Triangles{&b, tree_b},
                                        between.search_depth);
}

void build_smooth(const LayerDef& def, Mesh a, Mesh b, const SharedThickness& on_a, const SharedThickness& on_b,
                  JointModel::Layer& between) {
  const auto tree_a = std::make_shared<const TriangleTree>(a), tree_b = std::make_shared<const TriangleTree>(b);
  const auto buried = buried_deeper(a, tree_a, b, tree_b, between);
  const auto cells_a = std::make_shared<const SmoothCells>(std::move(a), between.a);
  const auto cells_b = std::make_shared<const SmoothCells>(std::move(b), between.b);
  const LayerLaw law = law_of(def);
  const auto side = [&](const auto& casting, const auto& target, const Tree& tree, const SharedThickness& own,
                        const SharedThickness& others) {
    return std::make_shared<const SmoothLayer>(
        SmoothDepths(casting, target, tree, between.search_depth, law, LayerThickness{def.thickness, own, others}));
  };
  between.layer = std::make_shared<const ElasticLayer>(
      std::vector<ElasticLayer::Side>{{true, 0.5, side(cells_a, cells_b, tree_b, on_a, on_b)},
                                      {false, 0.5, side(cells_b, cells_a, tree_a, on_b, on_a)}},
      buried, def.damping);
  between.tolerance = def.tolerance;
  between.most_level = kMaxLayerLevel;
}

}  // namespace

bool build_layer(const PlacedScene& scene, const Bones& bones, JointModel& model, std::size_t k, Diagnostics& out) {
  const LayerDef& def = scene.layers[k];
  JointModel::Layer& between = model.layers[k];
  const bool smooth = def.quadrature == LayerDef::Quadrature::smooth;
  const Facets facets(model, between, smooth ? kSmoothLayerEdgeShare : kLayerEdgeShare);
  Mesh a = facets.of(*between.a, between.body_a), b = facets.of(*between.b, between.body_b);
  SharedThickness on_a, on_b;
  const bool known_a = thickness_on(scene, bones, def.pair.surface_a, a, on_a, out),
             known_b = thickness_on(scene, bones, def.pair.surface_b, b, on_b, out);
  if (!known_a || !known_b) return false;
  between.thinnest = def.thickness + (on_a ? on_a->least() : 0) + (on_b ? on_b->least() : 0);
  between.thickest = def.thickness + (on_a ? on_a->most() : 0) + (on_b ? on_b->most() : 0);
  between.damping = def.damping;
  between.search_depth = def.search_depth > 0 ? def.search_depth : between.thickest;
  if (smooth) {
    build_smooth(def, std::move(a), std::move(b), on_a, on_b, between);
    return true;
  }
  const bool from_a = def.cast_from == def.pair.surface_a;
  const auto tree_a = std::make_shared<const TriangleTree>(a), tree_b = std::make_shared<const TriangleTree>(b);
  const LayerThickness thickness{def.thickness, from_a ? on_a : on_b, from_a ? on_b : on_a};
  const auto rim =
      def.rim == LayerDef::Rim::weighted ? std::make_shared<const RimCover>(from_a ? b : a, thickness.target) : nullptr;
  const auto casting = std::make_shared<TriangleLayer>(from_a ? a : b, from_a ? tree_b : tree_a, between.search_depth,
                                                       law_of(def), thickness, rim);
  between.layer = std::make_shared<const ElasticLayer>(std::vector<ElasticLayer::Side>{{from_a, 1.0, casting}},
                                                       buried_deeper(a, tree_a, b, tree_b, between), def.damping);
  return true;
}

bool share_layer(const PlacedScene& scene, const BuiltBefore& before, JointModel& model, std::size_t k) {
  if (before.model == nullptr || k >= before.model->layers.size() || k >= before.scene->layers.size()) return false;
  const JointModel::Layer& old = before.model->layers[k];
  JointModel::Layer& now = model.layers[k];
  const auto place = [&](const JointModel& m, int body) -> Vec3 {
    return m.reference_poses[at(body)].inverse() * joint_centre(m);
  };
  const bool same = scene.layers[k] == before.scene->layers[k] && now.a == old.a && now.b == old.b &&
                    model.scales.length == before.model->scales.length &&
                    model.scales.size == before.model->scales.size &&
                    place(model, now.body_a) == place(*before.model, old.body_a) &&
                    place(model, now.body_b) == place(*before.model, old.body_b);
  if (same) now = old;
  return same;
}

}  // namespace genu
