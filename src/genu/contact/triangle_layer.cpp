#include "genu/contact/triangle_layer.h"

#include <array>

#include <tbb/parallel_for.h>

#include "genu/contact/tolerances.h"

namespace genu {
namespace {

Vec3 area_vector(const Mesh& mesh, const std::array<int, 3>& t) {
  const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
  return 0.5 * (b - a).cross(c - a);
}

/// A ray from each triangle; a degenerate triangle sends a ray without weight.
std::vector<Ray> rays_from_triangles(const Mesh& mesh) {
  std::vector<Ray> rays;
  rays.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 centroid = (mesh.vertices[at(t[0])] + mesh.vertices[at(t[1])] + mesh.vertices[at(t[2])]) / 3;
    const Vec3 area = area_vector(mesh, t);
    const double size = area.norm();
    rays.push_back({centroid, size > 0 ? Vec3(-area / size) : Vec3::UnitZ()});
  }
  return rays;
}

}  // namespace

TriangleLayer::TriangleLayer(const Mesh& casting, std::shared_ptr<const TriangleTree> target, double search_depth,
                             const LayerLaw& law, LayerThickness thickness)
    : rays_(rays_from_triangles(casting), std::move(target), search_depth, LayerRays::Grouping::together),
      law_(law),
      thickness_(std::move(thickness)) {
  areas_.reserve(casting.triangles.size());
  for (const auto& t : casting.triangles) areas_.push_back(area_vector(casting, t).norm());
}

double TriangleLayer::thickness(int ray, const TriangleTree::Hit& hit, const Vec3& origin,
                                const Vec3& direction) const {
  const double own = thickness_.casting_at(ray);
  return thickness_.target ? own + thickness_.target->at(hit.triangle, origin + hit.distance * direction) : own;
}

double TriangleLayer::damped(const LayerMotion& motion, const Vec3& w, const Vec3& y) {
  return motion.damping == 0 ? 1 : motion.factor(w.dot(motion.velocity(y)));
}

/// d' = w . (velocity of the ray - velocity of the target), in the target's frame. With a measured thickness h it is
/// the rate of the depth that the pressure follows: d' - (d / h) h'.
Vec3 TriangleLayer::depth_rate(const TriangleTree::Hit& hit, const Vec3& direction, double h) const {
  const Vec3& plane = rays_.target().area_vector(hit.triangle);
  const Vec3 w = plane / -plane.dot(direction);
  if (!thickness_.target) return w;
  return w - hit.distance / h * thickness_rate(thickness_.target->gradient(hit.triangle), direction, w);
}

void TriangleLayer::add_part(int part, const Pose& X_TC, Memory& memory, const LayerMotion& motion,
                             LayerSum& out) const {
  rays_.cast_part(part, X_TC, memory,
                  [&](int k, const TriangleTree::Hit& hit, const Vec3& origin, const Vec3& direction) {
                    const Ray& ray = rays_.rays()[at(k)];
                    const double h = thickness(k, hit, origin, direction);
                    const LayerLaw::Pressure p = law_.at(hit.distance, h);
                    const Vec3 w = X_TC.R.transpose() * depth_rate(hit, direction, h);
                    const Vec3 y = ray.origin + hit.distance * ray.direction;
                    const double load = p.p * areas_[at(k)];
                    const double factor = damped(motion, w, y);
                    add_pressure(ray.origin, -ray.direction, y, w, factor * load, p.slope * areas_[at(k)], out);
                    out.load += load;
                    if (factor != 1)
                      out.damped += (factor - 1) * load * motion.velocity(ray.origin).dot(-ray.direction);
                  });
}

/// Each part is summed separately and the parts in order, so that the sum is the same for any number of threads.
void TriangleLayer::add(const Pose& X_TC, Memory& memory, LayerSum& out, int, const LayerMotion& motion) const {
  rays_.begin(memory);
  std::array<LayerSum, LayerRays::kMostParts> sums;
  const auto add = [&](int part) { add_part(part, X_TC, memory, motion, sums[at(part)]); };
  if (rays_.rays().size() >= kMinThreadedRays)
    tbb::parallel_for(0, rays_.parts(), add);
  else
    for (int part = 0; part < rays_.parts(); ++part) add(part);
  for (int part = 0; part < rays_.parts(); ++part) {
    const LayerSum& sum = sums[at(part)];
    out.wrench += sum.wrench;
    out.tangent += sum.tangent;
    out.load += sum.load;
    out.damped += sum.damped;
  }
}

void TriangleLayer::visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit, int,
                          const LayerMotion& motion) const {
  rays_.cast(X_TC, memory, [&](int k, const TriangleTree::Hit& hit, const Vec3& origin, const Vec3& direction) {
    const Ray& ray = rays_.rays()[at(k)];
    const double h = thickness(k, hit, origin, direction);
    double p = law_.at(hit.distance, h).p;
    if (motion.damping != 0)
      p *=
          damped(motion, X_TC.R.transpose() * depth_rate(hit, direction, h), ray.origin + hit.distance * ray.direction);
    visit({ray.origin, -ray.direction, areas_[at(k)], p * areas_[at(k)], hit.distance, p, hit.distance / h, k,
           thickness_.guessed(k, hit.triangle)});
  });
}

}  // namespace genu
