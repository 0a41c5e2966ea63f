#include "genu/contact/proximity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace genu {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kGroupSize = 12;
// Two refined minima closer than this are one: refinement ends well below, distinct minima of a surface sampled at
// tenths of millimetres stand well above.
constexpr double kSamePoint = 2e-6;  // m
// A sample nearer than this may have a closed contact beside it: half of a relative curvature of 1/(5 mm) times the square
// of a sample's distance to it, 1.2 mm at most.
constexpr double kNearContact = 1.5e-4;  // m
// Starts whose model has its minimum above this gap are not followed: the model errs by less between samples.
constexpr double kHopeless = 3e-5;  // m
// A descent that comes as near to a known minimum ends there; closer twins are found by probe_around().
constexpr double kMerge = 1e-4;  // m
// Outward normals within 60 degrees of each other: the sides cannot touch.
constexpr double kSameSide = 0.5;

/// The farthest that a point of the sphere (centre, radius) has moved between two poses.
double largest_motion(const Pose& from, const Pose& to, const Vec3& centre, double radius) {
  return (to * centre - from * centre).norm() + (to.R - from.R).norm() / std::sqrt(2.0) * radius;
}

void insert_distinct(std::vector<LocalMinimum>& list, const LocalMinimum& found) {
  for (const LocalMinimum& known : list)
    if ((known.contact.a.p - found.contact.a.p).norm() < kSamePoint &&
        (known.contact.b.p - found.contact.b.p).norm() < kSamePoint)
      return;
  list.push_back(found);
}

LocalMinimum oriented(LocalMinimum m, bool samples_b) {
  if (!samples_b) std::swap(m.contact.a, m.contact.b);
  return m;
}

}  // namespace

Proximity::Proximity(const Surface& a, const Surface& b, const Options& options)
    : queried_(&a), sampled_(&b), samples_b_(true), max_step_(options.max_step), far_(a) {
  // Sample the surface that is bounded by itself; a plane can be asked anywhere but has no natural extent. Between two
  // closed forms or two meshes the second is sampled.
  const bool a_global = a.is_global(), b_global = b.is_global();
  if (!a.is_unbounded() && (b.is_unbounded() || (!a_global && b_global))) {
    std::swap(queried_, sampled_);
    samples_b_ = false;
    far_ = FarDistance(b);
  }
  samples_ = sampled_->samples(options.spacing, Vec3::Zero(), options.reach);
  gap_.assign(samples_.points.size(), kInfinity);
  build_groups();
}

void Proximity::build_groups() {
  order_.resize(samples_.points.size());
  std::iota(order_.begin(), order_.end(), 0);
  struct Range {
    int first, last;
  };
  std::vector<Range> open{{0, static_cast<int>(order_.size())}};
  auto point = [&](int i) -> const Vec3& { return samples_.points[static_cast<std::size_t>(i)]; };
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    if (range.first == range.last) continue;
    Vec3 low = Vec3::Constant(kInfinity), high = -low;
    for (int k = range.first; k < range.last; ++k) {
      low = low.cwiseMin(point(order_[static_cast<std::size_t>(k)]));
      high = high.cwiseMax(point(order_[static_cast<std::size_t>(k)]));
    }
    if (range.last - range.first <= kGroupSize) {
      Group group;
      group.first = range.first;
      group.last = range.last;
      group.centre = 0.5 * (low + high);
      for (int k = range.first; k < range.last; ++k)
        group.radius = std::max(group.radius, (point(order_[static_cast<std::size_t>(k)]) - group.centre).norm());
      groups_.push_back(group);
      continue;
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const int middle = (range.first + range.last) / 2;
    std::nth_element(order_.begin() + range.first, order_.begin() + middle, order_.begin() + range.last,
                     [&](int i, int j) { return std::pair(point(i)[axis], i) < std::pair(point(j)[axis], j); });
    open.push_back({range.first, middle});
    open.push_back({middle, range.last});
  }
}

bool Proximity::clear(Group& group, const Pose& X_qs, double window) const {
  if (group.clearance - largest_motion(group.measured, X_qs, group.centre, group.radius) > window) return true;
  const Vec3 centre = X_qs * group.centre;
  // Inside the band the smooth gap is at hand, but is a distance to first order only: keep a third in reserve.
  constexpr double kReserve = 2.0 / 3;
  group.measured = X_qs;
  if (const auto gap = queried_->gap(centre)) {
    group.clearance = (queried_->is_global() ? *gap : kReserve * *gap) - group.radius;
  } else {
    group.clearance = far_.nearest(centre).distance - group.radius;
  }
  return group.clearance > window;
}

double Proximity::sample_gap(const Pose& X_qs, int sample, Vec3* direction) const {
  const auto i = static_cast<std::size_t>(sample);
  const Vec3 x = X_qs * samples_.points[i];
  const Vec3 normal = X_qs.R * samples_.normals[i];
  if (const auto gap = queried_->gap(x)) {
    SurfacePoint foot;
    if (direction == nullptr && *gap > 0) return *gap;
    if (!queried_->project(x, foot)) return kInfinity;
    if (direction != nullptr) *direction = foot.n;
    // The back of a thin shell, or a place beyond the edge of an open sheet: not an overlap of the two outer sides.
    if (*gap < 0 && (foot.n.dot(normal) > kSameSide || queried_->edge_distance(foot.p) < 0)) return kInfinity;
    return *gap;
  }
  const FarDistance::Nearest nearest = far_.nearest(x);
  if (direction != nullptr) *direction = nearest.direction;
  return nearest.distance;
}

void Proximity::measure(const Pose& X_qs, double window) {
  for (const int i : measured_) gap_[static_cast<std::size_t>(i)] = kInfinity;
  measured_.clear();
  for (Group& group : groups_) {
    if (clear(group, X_qs, window)) continue;
    for (int k = group.first; k < group.last; ++k) {
      const int i = order_[static_cast<std::size_t>(k)];
      gap_[static_cast<std::size_t>(i)] = sample_gap(X_qs, i, nullptr);
      measured_.push_back(i);
    }
  }
}

std::optional<Descent> Proximity::descend(const Pose& X_qs, const Vec3& start) const {
  auto descent = descend_gap(*queried_, *sampled_, X_qs, start, {.max_step = max_step_});
  if (descent) descent->minimum = oriented(descent->minimum, samples_b_);
  return descent;
}

bool Proximity::lowest_of_neighbours(int sample) const {
  const auto i = static_cast<std::size_t>(sample);
  for (int k = samples_.first_neighbour[i]; k < samples_.first_neighbour[i + 1]; ++k) {
    const int j = samples_.neighbours[static_cast<std::size_t>(k)];
    const double other = gap_[static_cast<std::size_t>(j)];
    if (other < gap_[i] || (other == gap_[i] && j < sample)) return false;
  }
  return true;
}

void Proximity::find_minima(const Pose& X_qs, double window, ProximityScan& out) {
  // A minimum between samples can hide beside a deeper one a few samples away: near contact every sample is a start, not
  // only the lowest among its neighbours. Most starts end after one evaluation, their model being hopeless or leading to
  // what is known.
  starts_.clear();
  for (const int sample : measured_) {
    const double gap = gap_[static_cast<std::size_t>(sample)];
    if (gap < std::min(window, kNearContact) || (gap < window && lowest_of_neighbours(sample))) starts_.push_back(sample);
  }
  std::sort(starts_.begin(), starts_.end(), [&](int i, int j) {
    return std::pair(gap_[static_cast<std::size_t>(i)], i) < std::pair(gap_[static_cast<std::size_t>(j)], j);
  });
  raw_.clear();
  for (const int sample : starts_) {
    const auto i = static_cast<std::size_t>(sample);
    const DescentLimits limits{max_step_, &raw_, kMerge, lowest_of_neighbours(sample) ? window : kHopeless};
    const auto descent = descend_gap(*queried_, *sampled_, X_qs, samples_.points[i], limits);
    if (!descent || !(descent->minimum.gap < window)) continue;
    const LocalMinimum found = oriented(descent->minimum, samples_b_);
    // A minimum past the edge matters only where the surface inside its edge is already reached.
    if (descent->settled && edge_distance(found.contact) >= 0) {
      raw_.push_back(descent->minimum);
      insert_distinct(out.minima, found);
    } else if (gap_[i] < 0) {
      insert_distinct(out.edge, found);
    }
  }
}

void Proximity::scan(const Pose& X_ab, double window, ProximityScan& out) {
  out.minima.clear();
  out.edge.clear();
  out.smallest_sample_gap = kInfinity;
  const Pose X_qs = query_from_samples(X_ab);
  measure(X_qs, window);
  int deepest = -1;
  for (const int sample : measured_) {
    const auto i = static_cast<std::size_t>(sample);
    if (gap_[i] < out.smallest_sample_gap) {
      out.smallest_sample_gap = gap_[i];
      deepest = sample;
    }
  }
  find_minima(X_qs, window, out);
  auto by_gap = [](const LocalMinimum& x, const LocalMinimum& y) { return x.gap < y.gap; };
  std::stable_sort(out.minima.begin(), out.minima.end(), by_gap);
  std::stable_sort(out.edge.begin(), out.edge.end(), by_gap);
  if (deepest >= 0) {
    const auto i = static_cast<std::size_t>(deepest);
    out.deepest = {samples_.points[i], Vec3::Zero(), gap_[i], samples_.areas[i]};
    sample_gap(X_qs, deepest, &out.deepest.direction);
  }
}

void Proximity::near_samples(const Pose& X_ab, double window, std::vector<NearSample>& out) {
  out.clear();
  const Pose X_qs = query_from_samples(X_ab);
  for (Group& group : groups_) {
    if (clear(group, X_qs, window)) continue;
    for (int k = group.first; k < group.last; ++k) {
      const int sample = order_[static_cast<std::size_t>(k)];
      const auto i = static_cast<std::size_t>(sample);
      NearSample near{samples_.points[i], Vec3::Zero(), 0, samples_.areas[i]};
      near.gap = sample_gap(X_qs, sample, &near.direction);
      if (near.gap < window) out.push_back(near);
    }
  }
}

std::optional<Descent> Proximity::follow(const Pose& X_ab, const ContactGeometry& contact) const {
  return descend(query_from_samples(X_ab), samples_b_ ? contact.b.p : contact.a.p);
}

double Proximity::edge_distance(const ContactGeometry& contact) const {
  const bool b = samples_b_;
  return std::min(queried_->edge_distance(b ? contact.a.p : contact.b.p),
                  sampled_->edge_distance(b ? contact.b.p : contact.a.p));
}

void Proximity::probe_around(const Pose& X_ab, const ContactGeometry& contact, double radius,
                             std::vector<LocalMinimum>& out) const {
  const Pose X_qs = query_from_samples(X_ab);
  const SurfacePoint& from = samples_b_ ? contact.b : contact.a;
  constexpr int kDirections = 8;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * M_PI * k / kDirections;
    SurfacePoint start;
    if (!sampled_->retract(from, radius * Vec2(std::cos(angle), std::sin(angle)), start)) continue;
    const auto descent = descend(X_qs, start.p);
    if (descent && descent->settled && edge_distance(descent->minimum.contact) >= 0)
      insert_distinct(out, descent->minimum);
  }
}

}  // namespace genu
