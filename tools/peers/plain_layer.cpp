#include "peers/plain_layer.h"

#include "genu/contact/elastic_layer.h"

namespace genu::peers {

PlainLayer::PlainLayer(const Mesh& casting, std::shared_ptr<const TriangleTree> target, double search_depth,
                       const LayerLaw& law, double thickness)
    : target_(std::move(target)), search_depth_(search_depth), thickness_(thickness), law_(law) {
  for (const auto& t : casting.triangles) {
    const auto v = [&](std::size_t i) -> const Vec3& { return casting.vertices[static_cast<std::size_t>(t[i])]; };
    const Vec3 area = 0.5 * (v(1) - v(0)).cross(v(2) - v(0));
    rays_.push_back({(v(0) + v(1) + v(2)) / 3, -area.normalized()});
    areas_.push_back(area.norm());
  }
  met_.assign(rays_.size(), -1);
}

void PlainLayer::add(const Pose& X_TC, Memory&, LayerSum& out, int, const LayerMotion&) const {
  for (std::size_t k = 0; k < rays_.size(); ++k) {
    const Ray& ray = rays_[k];
    const Vec3 direction = X_TC.R * ray.direction;
    const TriangleTree::Hit hit = target_->leaving(X_TC * ray.origin, direction, search_depth_, met_[k]);
    met_[k] = hit.triangle;
    if (!hit) continue;
    const LayerLaw::Pressure p = law_.at(hit.distance, thickness_);
    const Vec3& plane = target_->area_vector(hit.triangle);
    const Vec3 w = X_TC.R.transpose() * (plane / -plane.dot(direction));
    add_pressure(ray.origin, -ray.direction, ray.origin + hit.distance * ray.direction, w, p.p * areas_[k],
                 p.slope * areas_[k], out);
    out.load += p.p * areas_[k];
  }
}

void make_layers_plain(JointModel& model, const LayerLaw& law, double thickness) {
  for (JointModel::Layer& layer : model.layers) {
    std::vector<ElasticLayer::Side> sides = layer.layer->sides();
    for (ElasticLayer::Side& side : sides) {
      const Surface& casting = side.a ? *layer.a : *layer.b;
      side.quadrature = std::make_shared<PlainLayer>(casting.triangles(0, Vec3::Zero(), 0),
                                                     std::make_shared<const TriangleTree>(side.quadrature->target()),
                                                     layer.search_depth, law, thickness);
    }
    layer.layer = std::make_shared<const ElasticLayer>(std::move(sides));
  }
}

}  // namespace genu::peers
