#include "genu/contact/swallowed.h"

#include <algorithm>
#include <cmath>

#include "genu/contact/tolerances.h"

namespace genu {
namespace {

double box_diagonal(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

}  // namespace

Swallowed::Swallowed(const Surface& inner, const Surface& outer, const SampleSet& outer_samples, double spacing,
                     const Vec3& inner_centre, const Vec3& outer_centre, double reach)
    : outer_(&outer), spacing_(spacing), reach_(reach), outer_centre_(outer_centre) {
  if (inner.is_unbounded()) return;
  const SampleSet all = inner.samples(spacing, inner_centre, reach);
  for (const Vec3& p : thin_samples(all, std::max(spacing, box_diagonal(all.points) / kSwallowedSpacing)).points)
    points_.push_back({p});
  if (outer.knows_distance()) return;
  cover_ = 2 * kCoarseSampling * spacing;
  const SampleSet coarse = thin_samples(outer_samples, kCoarseSampling * spacing);
  near_points_ = coarse.points;
  near_normals_ = coarse.normals;
}

const FarDistance& Swallowed::far() {
  if (!far_) far_.emplace(*outer_, kCoarseSampling * spacing_, outer_centre_, reach_);
  return *far_;
}

double Swallowed::gap(const Vec3& x, double& clearance) {
  if (outer_->knows_distance()) {
    const double g = outer_->gap(x).value_or(0);
    clearance = std::abs(g);
    return g;
  }
  if (const double front = outer_->clear_in_front(x); front > 0) return clearance = front;
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < near_points_.size(); ++i) {
    const double square = (near_points_[i] - x).squaredNorm();
    if (square < least) least = square, nearest = i;
  }
  if (near_points_.empty()) return 0;
  const double side = near_normals_[nearest].dot(x - near_points_[nearest]);
  clearance = std::min(std::sqrt(least) - cover_, kSideKept * std::sqrt(least));
  if (side >= 0) return side;
  const FarDistance::Nearest found = far().nearest(x);
  const double distance = found.distance;
  clearance = std::min(std::abs(distance) - spacing_, found.same_side);
  if (distance >= 0) return distance;
  const auto smooth = outer_->gap(x);
  return smooth && *smooth < 0 ? std::max(*smooth, distance) : distance;
}

Swallowed::Depth Swallowed::deepest(const Pose& X_oi) {
  Depth out;
  for (Point& point : points_) {
    const Vec3 x = X_oi * point.p;
    if (point.clearance > (x - point.at).norm()) continue;
    const double g = gap(x, point.clearance);
    point.at = x;
    if (g >= -kFacetError * spacing_) continue;
    point.clearance = -1;  // only a point outside stays there while it is clear
    if (g < out.gap) out = {g, point.p};
  }
  return out;
}

}  // namespace genu
