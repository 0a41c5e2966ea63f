#include "genu/contact/layer_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace genu {
namespace {

constexpr int kTogether = 16;                                   // rays
constexpr std::array kClearances = {8.0, 2.0, 0.5, 0.1, 0.02};  // edges: tried from the largest
constexpr std::size_t kCoarseClearances = 3;                    // of them, for rays together
constexpr double kLookAgain = 3;  // edges: what was near is taken to be so until it has moved that far
constexpr double kPocket = 3;     // edges: the motion that triangles near a group are gathered for
constexpr double kLeast = 0.05;   // edges: the motion that what a ray can meet is listed for

}  // namespace

LayerRays::LayerRays(std::vector<Ray> rays, std::shared_ptr<const TriangleTree> target, double length,
                     Grouping grouping, std::vector<double> radii)
    : rays_(std::move(rays)),
      radii_(std::move(radii)),
      target_(std::move(target)),
      length_(length),
      levels_(grouping == Grouping::single ? kClearances.size() : kCoarseClearances),
      leaf_(grouping == Grouping::single ? 1 : kTogether),
      order_(rays_.size()) {
  double area = 0;
  for (int t = 0; t < target_->size(); ++t) area += target_->area_vector(t).norm();
  step_ = std::sqrt(area / std::max(1, target_->size()));
  std::iota(order_.begin(), order_.end(), 0);
  if (rays_.empty()) return;
  groups_.push_back({.first = 0, .last = static_cast<int>(rays_.size()), .middle = {}});
  for (std::size_t i = 0; i < groups_.size(); ++i) split(static_cast<int>(i));
}

void LayerRays::enclose(Group& group) const {
  Vec3 origin = Vec3::Zero(), direction = Vec3::Zero();
  for (int k = group.first; k < group.last; ++k) {
    const Ray& ray = rays_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])];
    origin += ray.origin / (group.last - group.first);
    direction += ray.direction;
  }
  const double norm = direction.norm();
  group.middle = {origin, norm > 0 ? Vec3(direction / norm) : Vec3::UnitZ()};
  const Vec3 end = origin + length_ * group.middle.direction;
  for (int k = group.first; k < group.last; ++k) {
    // The distance to the point of the middle ray at the same parameter is largest at one of the ends.
    const auto index = static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]);
    const Ray& ray = rays_[index];
    const double off = std::max((ray.origin - origin).norm(), (ray.origin + length_ * ray.direction - end).norm());
    group.radius = std::max(group.radius, off + (radii_.empty() ? 0.0 : radii_[index]));
  }
}

void LayerRays::split(int index) {
  enclose(groups_[static_cast<std::size_t>(index)]);
  const int first = groups_[static_cast<std::size_t>(index)].first,
            last = groups_[static_cast<std::size_t>(index)].last;
  if (last - first <= leaf_) {
    groups_[static_cast<std::size_t>(index)].leaf = leaves_++;
    return;
  }
  const auto place = [&](int ray) {
    const Ray& r = rays_[static_cast<std::size_t>(ray)];
    return Vec3(r.origin + 0.5 * length_ * r.direction);
  };
  Vec3 low = place(order_[static_cast<std::size_t>(first)]), high = low;
  for (int k = first; k < last; ++k) {
    low = low.cwiseMin(place(order_[static_cast<std::size_t>(k)]));
    high = high.cwiseMax(place(order_[static_cast<std::size_t>(k)]));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const int half = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last, [&](int a, int b) {
    const double x = place(a)[axis], y = place(b)[axis];
    return x < y || (x == y && a < b);
  });
  groups_[static_cast<std::size_t>(index)].children = static_cast<int>(groups_.size());
  groups_.push_back({.first = first, .last = half, .middle = {}});
  groups_.push_back({.first = half, .last = last, .middle = {}});
}

void LayerRays::begin(Memory& memory) const {
  memory.groups.resize(groups_.size());
  memory.open.clear();
  if (!groups_.empty()) memory.open.push_back(0);
}

/// How far (m) any point of the group's rays has moved from one pose to another, at most.
double LayerRays::motion(const Group& group, const Pose& from, const Pose& to) const {
  const Mat3 turn = to.R - from.R;
  const Vec3 start = turn * group.middle.origin + (to.p - from.p);
  const Vec3 end = start + length_ * (turn * group.middle.direction);
  const double rotation = turn.norm() / M_SQRT2;  // the spectral norm: a difference of rotations has it twice
  return std::sqrt(std::max(start.squaredNorm(), end.squaredNorm())) + rotation * group.radius;
}

void LayerRays::measure(const Group& group, const Pose& X_TC, Memory::Group& known) const {
  std::array<double, kClearances.size()> margins;
  for (std::size_t i = 0; i < levels_; ++i) margins[i] = group.radius + kClearances[i] * step_;
  const std::size_t level = target_->clear_by(X_TC * group.middle.origin, X_TC.R * group.middle.direction, length_,
                                              {margins.data(), levels_}, known.near);
  known.measured = X_TC;
  known.clear = level < levels_ ? kClearances[level] * step_ : 0;
}

bool LayerRays::clear(const Group& group, const Pose& X_TC, Memory::Group& known) const {
  if (group.children < 0 && leaf_ > 1) return false;  // to ask its rays costs no more
  if (known.clear >= 0) {
    const double moved = motion(group, known.measured, X_TC);
    if (moved < known.clear) return true;
    if (known.clear == 0 && moved < kLookAgain * step_) return false;
  }
  measure(group, X_TC, known);
  return known.clear > 0;
}

/// Brings a leaf to a pose, with triangles that are good for the least margin beyond it at least.
LayerRays::Memory::Block& LayerRays::advance(const Group& group, const Pose& X_TC, Memory& memory) const {
  Memory::Block& block = memory.blocks[static_cast<std::size_t>(group.leaf)];
  if (block.until >= 0) block.path += motion(group, block.last, X_TC);
  block.last = X_TC;
  if (block.path + kLeast * step_ <= block.until) return block;
  constexpr double kRounding = 1e-6;
  const double margin = (1 + kRounding) * (group.radius + kPocket * step_);
  target_->clusters_near(X_TC * group.middle.origin, X_TC.R * group.middle.direction, length_, margin, block.clusters);
  block.until = block.path + kPocket * step_;
  return block;
}

TriangleTree::Hit LayerRays::meet(const Vec3& origin, const Vec3& direction, const Memory::Block& block,
                                  Memory::AtRay& known) const {
  TrianglesAtRay& here = known.triangles;
  if (!(block.path < known.until)) {
    target_->at_ray(block.clusters, origin, direction, length_, kLeast * step_, kPocket * step_, here);
    known.until = std::min(block.path + here.margin, block.until);
  }
  if (here.count <= TrianglesAtRay::kMost)
    return target_->leaving({here.places.data(), static_cast<std::size_t>(here.count)}, origin, direction, length_);
  known.until = -1;
  return target_->leaving(block.clusters, origin, direction, length_);
}

}  // namespace genu
