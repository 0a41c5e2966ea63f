#include "genu/contact/triangle_layer.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// The same rays, begun earlier by `lead` (m).
std::vector<Ray> from_behind(std::vector<Ray> rays, double lead) {
  for (Ray& ray : rays) ray.origin -= lead * ray.direction;
  return rays;
}

}  // namespace

TriangleLayer::TriangleLayer(const Mesh& casting, std::shared_ptr<const TriangleTree> target, double search_depth,
                             const LayerLaw& law, LayerThickness thickness, std::shared_ptr<const RimCover> rim)
    : rays_(rays_from_triangles(casting), std::move(target), search_depth, LayerRays::Grouping::together),
      law_(law),
      thickness_(std::move(thickness)) {
  areas_.reserve(casting.triangles.size());
  for (const auto& t : casting.triangles) areas_.push_back(area_vector(casting, t).norm());
  if (!rim || rim->closed()) return;
  rim_ = std::move(rim);
  for (const double area : areas_) radii_.push_back(std::sqrt(area / M_PI));
  const double most = radii_.empty() ? 0 : *std::max_element(radii_.begin(), radii_.end()), lead = kRimDepth * most;
  rim_margin_ = kRimMargin * most;
  std::vector<double> reaches = radii_;
  for (double& reach : reaches) reach += rim_margin_;
  rim_rays_ = std::make_unique<const LayerRays>(from_behind(rays_.rays(), lead), rim_->facets(), lead + search_depth,
                                                LayerRays::Grouping::single, reaches);
}

double TriangleLayer::thickness(int ray, const TriangleTree::Hit& hit, const Vec3& origin,
                                const Vec3& direction) const {
  const double own = thickness_.casting_at(ray);
  return thickness_.target ? own + thickness_.target->at(hit.triangle, origin + hit.distance * direction) : own;
}

/// d' = w . (velocity of the ray - velocity of the target), in the target's frame. With a measured thickness h it is
/// the rate of the depth that the pressure follows: d' - (d / h) h'.
Vec3 TriangleLayer::depth_rate(const TriangleTree::Hit& hit, const Vec3& direction, double h) const {
  const Vec3& plane = rays_.target().area_vector(hit.triangle);
  const Vec3 w = plane / -plane.dot(direction);
  if (!thickness_.target) return w;
  return w - hit.distance / h * thickness_rate(thickness_.target->gradient(hit.triangle), direction, w);
}

/// Where a ray meets the target. Its share is that of a ray away from the rim.
TriangleLayer::Touch TriangleLayer::touch(int k, const Pose& X_TC, const TriangleTree::Hit& hit, const Vec3& origin,
                                          const Vec3& direction, const LayerMotion& motion) const {
  Touch out{.depth = hit.distance, .thickness = thickness(k, hit, origin, direction), .triangle = hit.triangle};
  const Ray& ray = rays_.rays()[at(k)];
  const Vec3 w = X_TC.R.transpose() * depth_rate(hit, direction, out.thickness);
  const Vec3 y = ray.origin + hit.distance * ray.direction;
  out.depth_rate << w, y.cross(w);
  if (motion.damping != 0) out.closing = w.dot(motion.velocity(y));
  return out;
}

void TriangleLayer::add_touch(int k, const Touch& touch, const LayerMotion& motion, LayerSum& out) const {
  const Ray& ray = rays_.rays()[at(k)];
  const LayerLaw::Pressure p = law_.at(touch.depth, touch.thickness);
  const double area = areas_[at(k)] * touch.share, load = p.p * area;
  const double factor = motion.damping == 0 ? 1 : motion.factor(touch.closing);
  Vec6 rate = p.slope * area * touch.depth_rate;
  if (touch.share != 1) rate += p.p * areas_[at(k)] * touch.share_rate;
  add_load(pressure_line(ray.origin, -ray.direction), factor * load, rate, out);
  out.load += load;
  if (factor != 1) out.damped += (factor - 1) * load * motion.velocity(ray.origin).dot(-ray.direction);
}

/// Lists the rays near the rim, with a margin so that the list holds for a while, and forgets where they were.
void TriangleLayer::find_near_rim(const Pose& X_TC, Memory& memory) const {
  RimRays& rim = memory.rim;
  if (!rim_) return;
  rim.side.resize(areas_.size(), RimRays::Side::away);
  if (!rim.known || !(rim_rays_->motion(rim.listed, X_TC) < rim_margin_)) {
    for (const int k : rim.near) rim.side[at(k)] = RimRays::Side::away;
    rim.near.clear();
    rim_rays_->each_near(X_TC, rim.rays, [&rim](int k) { rim.near.push_back(k); });
    rim.listed = X_TC;
    rim.known = true;
  }
  for (const int k : rim.near) rim.side[at(k)] = RimRays::Side::near;
}

template <typename Visit>
void TriangleLayer::each_beside(const Pose& X_TC, const RimRays& rim, const LayerMotion& motion, Visit visit) const {
  if (!rim_) return;
  for (const int k : rim.near) {
    if (rim.side[at(k)] == RimRays::Side::over) continue;
    const RimCover::Cover cover = rim_->beside(X_TC, disc(k));
    if (!(cover.share > kMinRimShare && cover.depth > 0)) continue;
    const Ray& ray = rays_.rays()[at(k)];
    if (rays_.target().entering(X_TC * ray.origin, X_TC.R * ray.direction, cover.depth)) continue;
    Touch out{.depth = cover.depth,
              .thickness = thickness_.casting_at(k) + cover.thickness,
              .depth_rate = cover.depth_rate,
              .share = cover.share,
              .share_rate = cover.share_rate,
              .triangle = cover.triangle};
    if (thickness_.target) out.depth_rate -= cover.depth / out.thickness * cover.thickness_rate;
    if (motion.damping != 0) out.closing = out.depth_rate.dot(motion.twist);
    visit(k, out);
  }
}

/// Calls visit(ray, touch) for every ray of a part that meets the target.
template <typename Visit>
void TriangleLayer::each_over(int part, const Pose& X_TC, Memory& memory, const LayerMotion& motion,
                              Visit visit) const {
  rays_.cast_part(part, X_TC, memory,
                  [&](int k, const TriangleTree::Hit& hit, const Vec3& origin, const Vec3& direction) {
                    Touch here = touch(k, X_TC, hit, origin, direction, motion);
                    if (rim_ && memory.rim.side[at(k)] != RimRays::Side::away) {
                      memory.rim.side[at(k)] = RimRays::Side::over;
                      const RimCover::Cover cover = rim_->over(X_TC, disc(k), hit.distance);
                      if (!(cover.share > kMinRimShare)) return;
                      here.share = cover.share;
                      here.share_rate = cover.share_rate;
                    }
                    visit(k, here);
                  });
}

/// Each part is summed separately and the parts in order, so that the sum is the same for any number of threads.
void TriangleLayer::add(const Pose& X_TC, Memory& memory, LayerSum& out, int, const LayerMotion& motion) const {
  rays_.begin(X_TC, memory);
  find_near_rim(X_TC, memory);
  std::array<LayerSum, LayerRays::kMostParts + 1> sums;
  const auto add_to = [&](LayerSum& sum) {
    return [this, &motion, &sum](int k, const Touch& touch) { add_touch(k, touch, motion, sum); };
  };
  const auto add = [&](int part) { each_over(part, X_TC, memory, motion, add_to(sums[at(part)])); };
  if (rays_.rays().size() >= kMinThreadedRays)
    tbb::parallel_for(0, rays_.parts(), add);
  else
    for (int part = 0; part < rays_.parts(); ++part) add(part);
  each_beside(X_TC, memory.rim, motion, add_to(sums[at(rays_.parts())]));
  for (int part = 0; part <= rays_.parts(); ++part) {
    const LayerSum& sum = sums[at(part)];
    out.wrench += sum.wrench;
    out.tangent += sum.tangent;
    out.load += sum.load;
    out.damped += sum.damped;
  }
}

void TriangleLayer::visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit, int,
                          const LayerMotion& motion) const {
  rays_.begin(X_TC, memory);
  find_near_rim(X_TC, memory);
  const auto point = [&](int k, const Touch& touch) {
    const Ray& ray = rays_.rays()[at(k)];
    const double factor = motion.damping == 0 ? 1 : motion.factor(touch.closing);
    const double p = factor * law_.at(touch.depth, touch.thickness).p, area = touch.share * areas_[at(k)];
    visit({ray.origin, -ray.direction, area, p * area, touch.depth, p, touch.depth / touch.thickness, k,
           thickness_.guessed(k, touch.triangle)});
  };
  for (int part = 0; part < rays_.parts(); ++part) each_over(part, X_TC, memory, motion, point);
  each_beside(X_TC, memory.rim, motion, point);
}

}  // namespace genu
