#include "genu/model/layer_report.h"

#include "genu/model/twist.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace genu {
namespace {

constexpr double kWithoutLimit = std::numeric_limits<double>::infinity();

/// Sums before division by area or force.
class Sum {
 public:
  void add(const LayerPoint& point, double share, const Vec3& x, const Vec3& n_on_b) {
    add_load(point.load, point.area, share, x, x, n_on_b);
    add_point(point);
  }

  /// `inside`: where it counts for the centre.
  void add_load(double whole_load, double area, double share, const Vec3& x, const Vec3& inside, const Vec3& n_on_b) {
    const double load = share * whole_load;
    totals_.force += load * n_on_b;
    totals_.moment += x.cross(Vec3(load * n_on_b));
    totals_.area += share * area;
    totals_.centre += load * inside;
    load_ += load;
  }

  void add_point(const LayerPoint& point) {
    totals_.max_pressure = std::max(totals_.max_pressure, point.pressure);
    totals_.max_depth = std::max(totals_.max_depth, point.depth);
    totals_.most_used = std::max(totals_.most_used, point.used);
    ++totals_.points;
  }

  double load() const { return load_; }
  double area() const { return totals_.area; }
  void scale(double loads, double areas) {
    totals_.force *= loads;
    totals_.moment *= loads;
    totals_.centre *= loads;
    load_ *= loads;
    totals_.area *= areas;
  }

  LayerTotals take(const Pose& X_ab, const Vec3& own_a, const Vec3& own_b) {
    if (load_ > 0) {
      const Vec3 centre = totals_.centre / load_;
      totals_.mean_pressure = load_ / totals_.area;
      totals_.centre = centre - own_b;
      totals_.centre_a = X_ab * centre - own_a;
      totals_.moment -= own_b.cross(totals_.force);
    }
    return totals_;
  }

 private:
  LayerTotals totals_;
  double load_ = 0;
};

/// A region as a box, infinite where it has no border.
struct Box {
  Vec3 low = Vec3::Constant(-kWithoutLimit), high = Vec3::Constant(kWithoutLimit);

  explicit Box(const RegionDef& region) {
    for (const RegionDef::Condition& c : region.conditions) {
      const bool above =
          c.comparison == RegionDef::Comparison::greater || c.comparison == RegionDef::Comparison::greater_equal;
      (above ? low : high)[c.axis] = above ? std::max(low[c.axis], c.value) : std::min(high[c.axis], c.value);
    }
  }

  /// The share of what is spread over `width` (m) to either side of x: from 1 to 0 across a border, so that regions
  /// that meet there have all of it together.
  double share(const Vec3& x, double width) const {
    const auto beyond = [&](double inside) { return std::clamp(0.5 + 0.5 * inside / width, 0.0, 1.0); };
    double out = 1;
    for (Eigen::Index i = 0; i < 3; ++i) out *= std::max(0.0, beyond(x[i] - low[i]) + beyond(high[i] - x[i]) - 1);
    return out;
  }
};

/// The parts of a contact in its regions. A triangle is in the region that its centre is in. A node of a smooth layer
/// is divided at a border over its width, by its pressure and area: its own share of the load may be negative at the
/// edge of contact. The parts are scaled to the whole.
class Parts {
 public:
  Parts(const std::vector<RegionDef>& regions, bool smooth)
      : regions_(regions), smooth_(smooth), sums_(regions.size()) {
    for (const RegionDef& region : regions) boxes_.emplace_back(region);
  }

  void add(const LayerPoint& point, double share, const Vec3& x, const Vec3& n_on_b) {
    if (!smooth_) {
      for (std::size_t r = 0; r < sums_.size(); ++r)
        if (regions_[r].contains(x)) sums_[r].add(point, share, x, n_on_b);
      return;
    }
    const double area = std::max(point.area, 0.0), load = point.pressure * area;
    if (!(load > 0)) return;
    all_.add_load(load, area, share, x, x, n_on_b);
    for (std::size_t r = 0; r < sums_.size(); ++r) {
      const double part = boxes_[r].share(x, kNodeWidth * std::sqrt(area));
      if (!(part > 0)) continue;
      sums_[r].add_load(load, area, part * share, x, x.cwiseMax(boxes_[r].low).cwiseMin(boxes_[r].high), n_on_b);
      sums_[r].add_point(point);
    }
  }

  std::vector<Sum>& scaled_to(const Sum& total) {
    if (smooth_ && all_.load() > 0 && all_.area() > 0)
      for (Sum& sum : sums_) sum.scale(total.load() / all_.load(), total.area() / all_.area());
    return sums_;
  }

 private:
  static constexpr double kNodeWidth = 0.5;  // of the root of its area: half the distance of nodes

  const std::vector<RegionDef>& regions_;
  bool smooth_;
  std::vector<Box> boxes_;
  std::vector<Sum> sums_;
  Sum all_;
};

}  // namespace

LayerReport report_layer(const JointModel& model, const std::vector<RegionDef>& regions, const State& state, int layer,
                         ElasticLayer::Memory& memory, const VecX* twist) {
  const auto& l = model.layers[at(layer)];
  Vec12 twists;
  if (twist != nullptr) twists << twist_of_body(model, l.body_a, *twist), twist_of_body(model, l.body_b, *twist);
  const Pose &X_Wa = state.poses[at(l.body_a)], &X_Wb = state.poses[at(l.body_b)];
  const Pose X_ba = X_Wb.inverse() * X_Wa;
  Sum total;
  Parts parts(regions, l.tolerance > 0);
  for (std::size_t i = 0; i < l.layer->sides().size(); ++i) {
    const auto& side = l.layer->sides()[i];
    l.layer->visit(
        X_Wa, X_Wb, i, memory,
        [&](const LayerPoint& point) {
          const Vec3 x = side.a ? X_ba * point.x : point.x;
          const Vec3 n_on_b = side.a ? Vec3(X_ba.R * point.n) : Vec3(-point.n);
          total.add(point, side.share, x, n_on_b);
          parts.add(point, side.share, x, n_on_b);
        },
        state.layer_level(at(layer)), twist != nullptr ? &twists : nullptr);
  }
  const Pose X_ab = X_ba.inverse();
  const Vec3 own_a = own_origin(model, l.body_a), own_b = own_origin(model, l.body_b);
  LayerReport report;
  report.total = total.take(X_ab, own_a, own_b);
  for (Sum& part : parts.scaled_to(total)) report.regions.push_back(part.take(X_ab, own_a, own_b));
  return report;
}

}  // namespace genu
