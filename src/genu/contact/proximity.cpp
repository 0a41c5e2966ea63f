#include "genu/contact/proximity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/contact/tolerances.h"
#include "genu/core/decompositions.h"

namespace genu {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The surface to sample is the bounded one (a plane can be queried anywhere but has no extent); of two closed forms or
/// two meshes it is the second.
bool samples_second(const Surface& a, const Surface& b) {
  return a.is_unbounded() || !(b.is_unbounded() || (!a.is_global() && b.is_global()));
}

/// Samples of a fine mesh are much closer than contacts have to be resolved.
bool too_dense(const SampleSet& samples, double spacing) {
  double area = 0;
  for (const double a : samples.areas) area += a;
  return samples.size() > 1000 && area / samples.size() < kDenseSamples * spacing * spacing;
}

void insert_distinct(std::vector<LocalMinimum>& list, const LocalMinimum& found, double same) {
  for (const LocalMinimum& known : list)
    if ((known.contact.a.p - found.contact.a.p).norm() < same && (known.contact.b.p - found.contact.b.p).norm() < same)
      return;
  list.push_back(found);
}

bool is_sphere(const Surface& surface) {
  const auto round = surface.round();
  return round && round->axis.isZero(0);
}

LocalMinimum oriented(LocalMinimum m, bool samples_b) {
  if (!samples_b) std::swap(m.contact.a, m.contact.b);
  return m;
}

}  // namespace

Proximity::Proximity(const Surface& a, const Surface& b, const Options& options)
    : options_(options),
      queried_(samples_second(a, b) ? &a : &b),
      sampled_(samples_second(a, b) ? &b : &a),
      samples_b_(samples_second(a, b)),
      spacing_(options.spacing),
      far_(*queried_, options.spacing, samples_b_ ? options.centre_a : options.centre_b, options.reach),
      reserve_(0.5 * options.spacing),
      rim_of_sampled_(*sampled_, *queried_, options.spacing, samples_b_ ? options.centre_b : options.centre_a,
                      options.reach),
      rim_of_queried_(*queried_, *sampled_, options.spacing, samples_b_ ? options.centre_a : options.centre_b,
                      options.reach) {
  SampleSet samples =
      sampled_->samples(options.spacing, samples_b_ ? options.centre_b : options.centre_a, options.reach);
  if (too_dense(samples, options.spacing)) samples = thin_samples(samples, options.spacing);
  samples_ = std::make_shared<const SampleSet>(std::move(samples));
  gap_.assign(samples_->points.size(), kInfinity);
  place_.assign(samples_->points.size(), -1);
  swallowed_.emplace(*queried_, *sampled_, *samples_, options.spacing, samples_b_ ? options.centre_a : options.centre_b,
                     samples_b_ ? options.centre_b : options.centre_a, options.reach);
  SampleTree tree = build_sample_tree(samples_->points);
  order_ = std::move(tree.order);
  for (const SampleNode& node : tree.nodes) groups_.push_back({node});
}

bool Proximity::is_between(const Surface& a, const Surface& b) const {
  return (samples_b_ ? queried_ : sampled_) == &a && (samples_b_ ? sampled_ : queried_) == &b;
}

bool Proximity::is_of(const Surface& a, const Surface& b, const Options& options) const {
  return is_between(a, b) && options.spacing == options_.spacing && options.reach == options_.reach &&
         options.centre_a == options_.centre_a && options.centre_b == options_.centre_b;
}

void Proximity::forget() {
  // Every search begins at the root: where that has not been looked at, nothing has.
  if (!groups_.empty() && touched_.empty()) return;
  for (const int g : touched_) {
    Group& group = groups_[at(g)];
    group.clearance = std::numeric_limits<double>::quiet_NaN();
    group.measured = Pose{};
  }
  touched_.clear();
  for (Tested& sample : tested_) sample.memory = Memory{};
  for (const int i : measured_) gap_[at(i)] = kInfinity;
  measured_.clear();
  swallowed_->forget();
  rim_of_sampled_.forget();
  rim_of_queried_.forget();
}

/// Whether the gap rises from a minimum in every direction by at least 0.005 of the spacing over one spacing.
bool Proximity::is_bowl(const Mat2& bend) const { return symmetric_eigen(bend).values[0] * spacing_ >= 0.01; }

double Proximity::motion(const Pose& from_ab, const Pose& to_ab) const {
  return groups_.empty() ? 0 : groups_[0].motion(query_from_samples(from_ab), query_from_samples(to_ab));
}

/// Calls visit(sample) for the samples of all leaves that are not known to be clear of the other surface by `window`.
template <typename Visit>
void Proximity::visit_near(const Pose& X_qs, double window, Visit visit) {
  if (groups_.empty()) return;
  open_.assign(1, 0);
  while (!open_.empty()) {
    const int index = open_.back();
    Group& group = groups_[at(index)];
    open_.pop_back();
    if (std::isnan(group.clearance)) touched_.push_back(index);
    if (clear(group, X_qs, window)) continue;
    if (group.children >= 0) {
      open_.push_back(group.children + 1);
      open_.push_back(group.children);
      continue;
    }
    Memory widest;  // of this leaf's samples that have been tested: what is clear round one is so round its neighbours
    for (int k = group.first; k < group.last; ++k) {
      const int i = order_[at(k)];
      Memory& known = tested(i).memory;
      const Vec3 x = X_qs * samples_->points[at(i)];
      if (known.clearance - (x - known.at).norm() > window) continue;
      if (const double clearance = widest.clearance - (x - widest.at).norm(); clearance > window) {
        known.clearance = clearance;
        known.at = x;
        continue;
      }
      known.clearance = queried_->clear_in_front(x);
      known.at = x;
      if (known.clearance > window) continue;
      visit(i);
      if (const Memory& now = tested(i).memory; now.clearance > widest.clearance) widest = now;
    }
  }
}

/// A lower bound of the distance from a gap. Within the band of a mesh the gap is the distance to first order only: use
/// a third. Closed forms without a distance function have a gap everywhere, but no such band.
std::optional<double> Proximity::near_clearance(std::optional<double> gap) const {
  if (!gap || queried_->knows_distance()) return gap;
  return queried_->is_global() ? std::nullopt : std::optional(kFirstOrderGap * *gap);
}

/// For everything within `radius` of a point beyond the band. The distance is to facets, which differ from the smooth
/// surface by less than half of the samples' spacing. A point far from an open sheet may be in front of it or behind
/// it. A `large` group is entirely on the side of its centre only if it is small against its distance; leaves count as
/// small.
double Proximity::far_clearance(const FarDistance::Nearest& nearest, double radius, bool large) const {
  return std::min(nearest.distance - radius - reserve_, large ? nearest.same_side - radius : nearest.same_side);
}

bool Proximity::clear(Group& group, const Pose& X_qs, double window) const {
  const double moved = group.motion(group.measured, X_qs);
  if (group.clearance - moved > window) return true;
  // It may be clear after moving straight away; bodies in contact roll and slide instead.
  if (group.clearance + kClearanceUse * moved <= window) return false;
  const Vec3 centre = X_qs * group.centre;
  group.measured = X_qs;
  if (const double front = queried_->clear_in_front(centre); front > 0)
    group.clearance = front - group.radius;
  else if (const auto clearance = near_clearance(queried_->gap(centre)))
    group.clearance = *clearance - group.radius;
  else
    group.clearance = far_clearance(far_.nearest(centre), group.radius, group.children >= 0);
  return group.clearance > window;
}

double Proximity::sample_gap(const Pose& X_qs, int sample, Vec3* direction) {
  const auto i = static_cast<std::size_t>(sample);
  const Vec3 x = X_qs * samples_->points[i];
  const Vec3 normal = X_qs.R * samples_->normals[i];
  auto& [memory, foot, own] = tested(sample);
  memory.at = x;
  if (const auto gap = queried_->gap_and_foot(x, foot)) {
    if (const auto near = near_clearance(gap)) memory.clearance = *near;
    if (direction == nullptr && *gap > kShallowOverlap * spacing_) return *gap;
    if (!foot && !queried_->project(x, foot.emplace())) {
      foot.reset();
      return *gap > 0 ? *gap : kInfinity;
    }
    if (direction != nullptr) *direction = foot->n;
    const bool same_way = foot->n.dot(normal) > kSameWayCosine, beyond = queried_->edge_distance(foot->p) < 0;
    if (same_way && !beyond && std::abs(*gap) <= kShallowOverlap * spacing_)
      if (const double depth = depth_behind(X_qs, sample); depth < 0) return memory.clearance = -1, depth;
    // The back of a thin shell, or a place beyond the edge of an open sheet: usually no overlap.
    if (*gap < 0 && (same_way || beyond)) return doubtful_gap(x, *gap, memory);
    return *gap;
  }
  foot.reset();
  const FarDistance::Nearest nearest = far_.nearest(x);
  memory.clearance = far_clearance(nearest, 0, false);
  if (direction != nullptr) *direction = nearest.direction;
  return nearest.distance;
}

/// Where both surfaces coincide and face the same way, as for bodies that occupy the same space, the gap is no
/// evidence. Returns the depth inside both of a point behind both; 0 where it is not inside both.
double Proximity::depth_behind(const Pose& X_qs, int sample) {
  const Vec3 behind = samples_->points[at(sample)] - kBehindSample * spacing_ * samples_->normals[at(sample)];
  if (swallowed_->distance_to_outer(behind) > -kSwallowedDepth * spacing_) return 0;
  const double depth = far_.nearest(X_qs * behind).distance;
  return depth < -kSwallowedDepth * spacing_ ? depth : 0;
}

/// The gap at a point where the smooth surface gives a value < 0 for the wrong side of a sharp rim, or past an edge. It
/// counts only if the facets agree: then the point is inside, as for a small body swallowed by a large one.
double Proximity::doubtful_gap(const Vec3& x, double gap, Memory& memory) const {
  if (memory.doubt - (x - memory.doubted_at).norm() > 0) return kInfinity;
  const FarDistance::Nearest facets = far_.nearest(x);
  memory.doubted_at = x;
  memory.doubt = std::min(facets.distance + kShallowOverlap * spacing_, facets.same_side);
  return facets.distance < -kShallowOverlap * spacing_ ? std::max(gap, facets.distance) : kInfinity;
}

void Proximity::measure(const Pose& X_qs, double window) {
  for (const int i : measured_) gap_[static_cast<std::size_t>(i)] = kInfinity;
  measured_.clear();
  visit_near(X_qs, window, [&](int i) {
    gap_[at(i)] = sample_gap(X_qs, i, nullptr);
    measured_.push_back(i);
  });
}

std::optional<Descent> Proximity::descend(const Pose& X_qs, const Vec3& start) const {
  auto descent = descend_gap(*queried_, *sampled_, X_qs, start, {.max_step = spacing_});
  if (descent) descent->minimum = oriented(descent->minimum, samples_b_);
  return descent;
}

/// The descent from a sample that has just been measured: its foot is known, and where it lies on its own surface is
/// found once.
std::optional<Descent> Proximity::descend_from(int sample, const Pose& X_qs, const DescentLimits& limits) {
  const Vec3& point = samples_->points[at(sample)];
  auto& [memory, foot, own] = tested(sample);
  if (!own && !sampled_->project(point, own.emplace())) {
    own.reset();
    return std::nullopt;
  }
  return descend_gap(*queried_, *sampled_, X_qs, point, limits, {&*own, foot ? &*foot : nullptr});
}

bool Proximity::lowest_of_neighbours(int sample) const {
  const auto i = static_cast<std::size_t>(sample);
  for (int k = samples_->first_neighbour[i]; k < samples_->first_neighbour[i + 1]; ++k) {
    const int j = samples_->neighbours[static_cast<std::size_t>(k)];
    const double other = gap_[static_cast<std::size_t>(j)];
    if (other < gap_[i] || (other == gap_[i] && j < sample)) return false;
  }
  return true;
}

/// Whether the gap at a sample agrees with the curvature at a known minimum. A second minimum of the same depth lowers
/// the samples next to it by more: it lies where the bowl has risen by at least 1/800 of the spacing.
bool Proximity::slopes_to_known(int sample) const {
  for (const Descent& raw : raw_) {
    const SurfacePoint& from = raw.minimum.contact.b;
    const Vec3 away = samples_->points[at(sample)] - from.p;
    const double distance = away.norm();
    if (distance < kFlankNear * spacing_ || distance > kFlankFar * spacing_ || !is_bowl(raw.bend)) continue;
    if (!(samples_->normals[at(sample)].dot(from.n) > 0)) continue;  // through a thin body
    const Vec2 d = from.T.transpose() * away;
    const double rise = 0.5 * d.dot(raw.bend * d);
    if (rise > 0 && std::abs(gap_[at(sample)] - raw.minimum.gap - rise) <= kFlankShare * rise) return true;
  }
  return false;
}

void Proximity::find_minima(const Pose& X_qs, double window, ProximityScan& out) {
  // A minimum between samples may be hidden beside a deeper one a few samples away. So near contact every sample is a
  // start, not only local minima among samples. Most starts end after one evaluation, because their model has no low
  // minimum or leads to a known one.
  starts_.clear();
  for (const int sample : measured_) {
    const double gap = gap_[static_cast<std::size_t>(sample)];
    const bool near_contact = std::abs(gap) < std::min(window, kNearContact * spacing_);
    if (near_contact || (gap < window && lowest_of_neighbours(sample))) starts_.push_back(sample);
  }
  std::sort(starts_.begin(), starts_.end(), [&](int i, int j) {
    return std::pair(gap_[static_cast<std::size_t>(i)], i) < std::pair(gap_[static_cast<std::size_t>(j)], j);
  });
  raw_.clear();
  const bool spheres = is_sphere(*queried_) && is_sphere(*sampled_);  // whose gap has one minimum
  // Surfaces with more minima than this conform. Minima not examined still count through the gaps of samples.
  for (const int sample : starts_) {
    if (raw_.size() >= kMaxMinima) break;
    if (slopes_to_known(sample)) continue;
    const auto i = static_cast<std::size_t>(sample);
    const bool lowest = lowest_of_neighbours(sample);
    const DescentLimits limits{.max_step = spacing_,
                               .known = raw_,
                               .same = kMergeDistance * spacing_,
                               .bowl = kBowlFar * spacing_,
                               .hopeless = lowest ? window : kHopelessGap * spacing_,
                               .farthest = lowest ? kInfinity : kBetweenSamples * spacing_};
    const auto descent = descend_from(sample, X_qs, limits);
    if (!descent || !(descent->minimum.gap < window)) continue;
    const LocalMinimum found = oriented(descent->minimum, samples_b_);
    // A minimum past the edge matters only where the surface is already reached inside its edge.
    if (descent->settled && edge_distance(found.contact) >= 0) {
      raw_.push_back(*descent);
      insert_distinct(out.minima, found, kSamePoint * spacing_);
      if (spheres) break;
    } else if (gap_[i] < 0) {
      insert_distinct(out.edge, found, kSamePoint * spacing_);
    }
  }
}

void Proximity::find_rims(const Pose& X_qs, ProximityScan& out) {
  rims_.clear();
  if (!rim_of_sampled_.empty()) rim_of_sampled_.scan(X_qs, rims_);
  const std::size_t of_sampled = rims_.size();
  if (!rim_of_queried_.empty()) rim_of_queried_.scan(X_qs.inverse(), rims_);
  for (std::size_t k = of_sampled; k < rims_.size(); ++k) std::swap(rims_[k].contact.a, rims_[k].contact.b);
  for (const LocalMinimum& m : rims_) insert_distinct(out.edge, oriented(m, samples_b_), kSamePoint * spacing_);
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
  out.swallowed = swallowed_->deepest(X_qs.inverse()).gap;
  find_minima(X_qs, window, out);
  find_rims(X_qs, out);
  auto by_gap = [](const LocalMinimum& x, const LocalMinimum& y) { return x.gap < y.gap; };
  std::stable_sort(out.minima.begin(), out.minima.end(), by_gap);
  std::stable_sort(out.edge.begin(), out.edge.end(), by_gap);
  if (deepest >= 0) {
    const auto i = static_cast<std::size_t>(deepest);
    out.deepest = {samples_->points[i], Vec3::Zero(), gap_[i], samples_->areas[i]};
    sample_gap(X_qs, deepest, &out.deepest.direction);
  }
}

double Proximity::smallest_sample_gap(const Pose& X_ab) {
  double smallest = kInfinity;
  const Pose X_qs = query_from_samples(X_ab);
  visit_near(X_qs, 0, [&](int sample) { smallest = std::min(smallest, sample_gap(X_qs, sample, nullptr)); });
  const double swallowed = swallowed_->deepest(X_qs.inverse()).gap;
  return swallowed < 0 ? std::min(smallest, swallowed) : smallest;
}

void Proximity::near_samples(const Pose& X_ab, double window, std::vector<NearSample>& out) {
  out.clear();
  const Pose X_qs = query_from_samples(X_ab);
  visit_near(X_qs, window, [&](int sample) {
    NearSample near{samples_->points[at(sample)], Vec3::Zero(), 0, samples_->areas[at(sample)]};
    near.gap = sample_gap(X_qs, sample, &near.direction);
    if (near.gap < window) out.push_back(near);
  });
}

std::optional<Descent> Proximity::follow(const Pose& X_ab, const ContactGeometry& contact) const {
  return descend(query_from_samples(X_ab), samples_b_ ? contact.b.p : contact.a.p);
}

double Proximity::edge_distance(const ContactGeometry& contact) const {
  const bool b = samples_b_;
  return std::min(queried_->edge_distance(b ? contact.a.p : contact.b.p),
                  sampled_->edge_distance(b ? contact.b.p : contact.a.p));
}

void Proximity::probe_around(const Pose& X_ab, const ContactGeometry& contact, double radius, double steep,
                             std::vector<LocalMinimum>& out) const {
  const Pose X_qs = query_from_samples(X_ab);
  const SurfacePoint &from = samples_b_ ? contact.b : contact.a, &other = samples_b_ ? contact.a : contact.b;
  const Mat2 turn = (X_qs.R * from.T).transpose() * other.T;
  const SymmetricEigen<2> bend = symmetric_eigen(Mat2(-(from.S + turn * other.S * turn.transpose())));
  const int directions = bend.values[1] > steep ? 2 : 8;
  const double first = std::atan2(bend.vectors(1, 0), bend.vectors(0, 0));
  const Descent here{{{other, from}, 0}, true};  // where most of them end
  const DescentLimits limits{.max_step = spacing_, .known = {&here, 1}, .same = kSamePoint * spacing_};
  for (int k = 0; k < directions; ++k) {
    const double angle = first + 2 * M_PI * k / directions;
    SurfacePoint start;
    if (!sampled_->retract(from, radius * Vec2(std::cos(angle), std::sin(angle)), start)) continue;
    const auto descent = descend_gap(*queried_, *sampled_, X_qs, start.p, limits, {&start, nullptr});
    if (!descent || !descent->settled) continue;
    const LocalMinimum found = oriented(descent->minimum, samples_b_);
    if (edge_distance(found.contact) >= 0) insert_distinct(out, found, kSamePoint * spacing_);
  }
}

}  // namespace genu
