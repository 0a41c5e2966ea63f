#include "genu/contact/layer_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "genu/contact/tolerances.h"

namespace genu {
namespace {

constexpr int kTogether = 64;                 // rays
constexpr std::size_t kCoarseClearances = 3;  // of them, for rays together

}  // namespace

LayerRays::LayerRays(std::vector<Ray> rays, std::shared_ptr<const TriangleTree> target, double length,
                     Grouping grouping, std::vector<double> radii, double lead)
    : rays_(std::move(rays)),
      radii_(std::move(radii)),
      target_(std::move(target)),
      length_(length),
      lead_(lead),
      levels_(grouping == Grouping::single ? kClearances.size() : kCoarseClearances),
      leaf_(grouping == Grouping::single ? 1 : kTogether),
      order_(rays_.size()) {
  double area = 0;
  for (int t = 0; t < target_->size(); ++t) area += target_->area_vector(t).norm();
  step_ = std::sqrt(area / std::max(1, target_->size()));
  std::iota(order_.begin(), order_.end(), 0);
  if (leaf_ > 1 && target_->size() > 0) atlas_ = std::make_shared<const SheetAtlas>(target_, length_);
  if (rays_.empty()) return;
  groups_.push_back({.first = 0, .last = static_cast<int>(rays_.size()), .middle = {}});
  for (std::size_t i = 0; i < groups_.size(); ++i) split(static_cast<int>(i));
  find_parts();
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
    // The distance to the point of the central ray at the same parameter is largest at one of the ends.
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

/// Halves the largest group until there are enough.
void LayerRays::find_parts() {
  parts_ = {0};
  const auto size = [&](int group) { return groups_[at(group)].last - groups_[at(group)].first; };
  while (static_cast<int>(parts_.size()) < kMostParts) {
    const auto largest =
        std::max_element(parts_.begin(), parts_.end(), [&](int a, int b) { return size(a) < size(b); });
    const int children = groups_[at(*largest)].children;
    if (children < 0) break;
    *largest = children;
    parts_.insert(largest + 1, children + 1);
  }
}

void LayerRays::prepare(Memory& memory) const {
  memory.groups.resize(groups_.size());
  memory.open.resize(parts_.size());
  if (leaf_ == 1) return;
  memory.blocks.resize(at(leaves_));
  memory.rays.resize(rays_.size());
  memory.skip_until.resize(rays_.size(), -1);
}

void LayerRays::begin(const Pose& X_TC, Memory& memory) const {
  prepare(memory);
  for (std::size_t i = 0; i < Memory::kCasts; ++i) {
    const Memory::Cast& cast = memory.casts[i];
    if (cast.done.size() != parts_.size() || !(cast.at == X_TC)) continue;
    memory.cast = i;
    return;
  }
  memory.cast = memory.oldest;
  memory.oldest = (memory.oldest + 1) % Memory::kCasts;
  Memory::Cast& cast = memory.casts[memory.cast];
  cast.at = X_TC;
  cast.found.resize(parts_.size());
  cast.done.assign(parts_.size(), 0);
}

/// m: upper bound of the motion of any point of the group's rays between two poses.
double LayerRays::motion(const Group& group, const Pose& from, const Pose& to) const {
  const Mat3 turn = to.R - from.R;
  const Vec3 start = turn * group.middle.origin + (to.p - from.p);
  const Vec3 end = start + length_ * (turn * group.middle.direction);
  const double rotation = turn.norm() / M_SQRT2;  // the spectral norm: a difference of rotations has it twice
  return std::sqrt(std::max(start.squaredNorm(), end.squaredNorm())) + rotation * group.radius;
}

/// m: lower bound of a group's clearance from the target; 0: it may be near. `near`: a triangle that was near last.
double LayerRays::measure(const Group& group, const Pose& X_TC, int& near) const {
  std::array<double, kClearances.size()> margins;
  for (std::size_t i = 0; i < levels_; ++i) margins[i] = group.radius + kClearances[i] * step_;
  const std::size_t level = target_->clear_by(X_TC * group.middle.origin, X_TC.R * group.middle.direction, length_,
                                              {margins.data(), levels_}, TriangleTree::Way::out, near);
  return level < levels_ ? kClearances[level] * step_ : 0;
}

bool LayerRays::clear(const Group& group, const Pose& X_TC, Memory::Group& known) const {
  if (known.clear >= 0) {
    const double moved = motion(group, known.measured, X_TC);
    if (moved < known.clear) return true;
    if (known.clear == 0 && moved < kRecheckMotion * step_) return false;
  }
  known.clear = measure(group, X_TC, known.near);
  known.measured = X_TC;
  return known.clear > 0;
}

/// The same for a leaf whose rays are cast.
bool LayerRays::clear(const Group& group, const Pose& X_TC, Memory::Block& block) const {
  if (block.path < block.empty_until) return true;
  if (block.path < block.near_until) return false;
  const double clear = measure(group, X_TC, block.near);
  block.empty_until = block.path + clear;
  if (clear == 0) block.near_until = block.path + kRecheckMotion * step_;
  if (block.piece < 0 && block.near >= 0) block.piece = atlas_->piece_of(target_->place_of(block.near));
  return clear > 0;
}

LayerRays::Memory::Block& LayerRays::advance(const Group& group, const Pose& X_TC, Memory& memory) const {
  Memory::Block& block = memory.blocks[at(group.leaf)];
  block.path = block.path < 0 ? 0 : block.path + motion(group, block.last, X_TC);
  block.last = X_TC;
  return block;
}

/// Ensures that a leaf has all triangles needed for at least the least motion beyond it.
void LayerRays::gather(const Group& group, Memory::Block& block) const {
  if (block.path + kMinListedMotion * step_ <= block.until) return;
  const double margin = (1 + kMarginRounding) * (group.radius + kPocketMotion * step_);
  const Pose& X_TC = block.last;
  target_->clusters_near(X_TC * group.middle.origin, X_TC.R * group.middle.direction, length_, margin, block.clusters);
  block.until = block.path + kPocketMotion * step_;
}

TriangleTree::Hit LayerRays::meet(const Ray& ray, const Group& group, Memory::Block& block,
                                  Memory::AtRay& known) const {
  if (!(block.path < known.until)) {
    TriangleTree::Hit hit;
    if (known.piece >= 0 && meet_sheet(ray, block, known, hit)) return hit;
    if (block.piece >= 0 && block.piece != known.piece) {
      known.piece = block.piece;
      known.facet = block.facet;
      if (meet_sheet(ray, block, known, hit)) return hit;
      known.piece = -1;
    }
    gather(group, block);
    if (block.clusters.count == 0) {
      known.triangles.count = 0;
      known.until = block.until;
      return {};
    }
    target_->at_ray(block.clusters, ray.origin, ray.direction, length_, kMinListedMotion * step_, kPocketMotion * step_,
                    known.triangles);
    known.until = std::min(block.path + known.triangles.margin, block.until);
  }
  return meet_listed(ray, block, known);
}

/// Whether the ray starts outside the target and passes through it: what it measures is no overlap.
bool LayerRays::enters_before(const Ray& ray, const TriangleTree::Hit& hit, const Memory::Block& block,
                              Memory::AtRay& known) const {
  const double distance = hit.distance - lead_;
  if (!(distance > 0) || (block.path < known.unentered_until && distance <= known.unentered)) return false;
  const Vec3 start = ray.origin + lead_ * ray.direction;
  if (!(block.path < known.unentered_next_time)) {
    const double length = std::min(length_ - lead_, distance + kUnenteredLength * step_);
    std::array<double, kCoarseClearances> margins;
    for (std::size_t i = 0; i < margins.size(); ++i) margins[i] = kClearances[i] * step_;
    int near = -1;
    const std::size_t level = target_->clear_by(start, ray.direction, length, margins, TriangleTree::Way::in, near);
    if (level < margins.size()) {
      known.unentered = length;
      known.unentered_until = block.path + margins[level] / (1 + kMarginRounding);
      return false;
    }
    known.unentered_next_time = block.path + kRetryUnentered * step_;
  }
  return static_cast<bool>(target_->entering(start, ray.direction, distance));
}

/// The hit of a ray, if the sheet that it crossed last gives it.
bool LayerRays::meet_sheet(const Ray& ray, Memory::Block& block, Memory::AtRay& known, TriangleTree::Hit& hit) const {
  const TriangleSheet& sheet = atlas_->sheet(known.piece);
  if (!sheet.good()) return false;
  const TriangleSheet::Meeting meeting = sheet.meet(*target_, ray.origin, ray.direction, length_, known.facet);
  if (meeting.place >= 0 && !meeting.roomy) {
    const int piece = atlas_->piece_of(meeting.place);
    if (piece != known.piece) known.facet = 0;
    known.piece = piece;
  }
  if (!meeting.sure) return false;
  block.piece = known.piece;
  block.facet = known.facet;
  hit = meeting.hit;
  known.triangles.count = hit ? 1 : 0;
  known.until = hit ? -1 : block.path + meeting.clear;
  if (hit && !meeting.alone && enters_before(ray, hit, block, known)) hit = {};
  return true;
}

TriangleTree::Hit LayerRays::meet_listed(const Ray& ray, Memory::Block& block, Memory::AtRay& known) const {
  TrianglesAtRay& here = known.triangles;
  TriangleTree::Hit hit;
  if (here.count <= TrianglesAtRay::kMost) {
    hit = target_->leaving({here.places.data(), at(here.count)}, ray.origin, ray.direction, length_);
  } else {
    known.until = -1;
    hit = target_->leaving(block.clusters, ray.origin, ray.direction, length_);
  }
  if (known.piece < 0 && (hit || here.nearest >= 0)) {
    known.piece = atlas_->piece_of(hit ? target_->place_of(hit.triangle) : target_->first_place(here.nearest));
    known.facet = 0;
  }
  return hit && enters_before(ray, hit, block, known) ? TriangleTree::Hit() : hit;
}

}  // namespace genu
