#include "genu/model/layer_report.h"

#include "genu/model/twist.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace genu {
namespace {

/// Sums before division by area or force.
class Sum {
 public:
  void add(const LayerPoint& point, double share, const Vec3& x, const Vec3& n_on_b) {
    const double load = share * point.load;
    totals_.force += load * n_on_b;
    totals_.moment += x.cross(Vec3(load * n_on_b));
    totals_.area += share * point.area;
    totals_.centre += load * x;
    load_ += load;
    totals_.max_pressure = std::max(totals_.max_pressure, point.pressure);
    totals_.max_depth = std::max(totals_.max_depth, point.depth);
    totals_.most_used = std::max(totals_.most_used, point.used);
    ++totals_.points;
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

/// The share of a region in what a node of a smooth layer carries, which is spread as widely as its area is: from 1 to
/// 0 across a border, so that regions that meet there have all of it together. A triangle belongs to the region that
/// its centre is in.
double share_of(const RegionDef& region, const Vec3& x, double width) {
  if (!(width > 0)) return region.contains(x) ? 1 : 0;
  constexpr double kWithoutLimit = std::numeric_limits<double>::infinity();
  Vec3 low = Vec3::Constant(-kWithoutLimit), high = Vec3::Constant(kWithoutLimit);
  for (const RegionDef::Condition& c : region.conditions) {
    const bool above =
        c.comparison == RegionDef::Comparison::greater || c.comparison == RegionDef::Comparison::greater_equal;
    (above ? low : high)[c.axis] = above ? std::max(low[c.axis], c.value) : std::min(high[c.axis], c.value);
  }
  const auto beyond = [&](double inside) { return std::clamp(0.5 + 0.5 * inside / width, 0.0, 1.0); };
  double share = 1;
  for (Eigen::Index i = 0; i < 3; ++i) share *= std::max(0.0, beyond(x[i] - low[i]) + beyond(high[i] - x[i]) - 1);
  return share;
}

}  // namespace

LayerReport report_layer(const JointModel& model, const std::vector<RegionDef>& regions, const State& state, int layer,
                         ElasticLayer::Memory& memory, const VecX* twist) {
  const auto& l = model.layers[at(layer)];
  Vec12 twists;
  if (twist != nullptr) twists << twist_of_body(model, l.body_a, *twist), twist_of_body(model, l.body_b, *twist);
  const Pose &X_Wa = state.poses[at(l.body_a)], &X_Wb = state.poses[at(l.body_b)];
  const Pose X_ba = X_Wb.inverse() * X_Wa;
  const bool smooth = l.tolerance > 0;
  Sum total;
  std::vector<Sum> parts(regions.size());
  for (std::size_t i = 0; i < l.layer->sides().size(); ++i) {
    const auto& side = l.layer->sides()[i];
    l.layer->visit(
        X_Wa, X_Wb, i, memory,
        [&](const LayerPoint& point) {
          const Vec3 x = side.a ? X_ba * point.x : point.x;
          const Vec3 n_on_b = side.a ? Vec3(X_ba.R * point.n) : Vec3(-point.n);
          total.add(point, side.share, x, n_on_b);
          const double width = smooth ? std::sqrt(std::abs(point.area)) : 0;
          for (std::size_t r = 0; r < regions.size(); ++r)
            if (const double share = share_of(regions[r], x, width); share > 0)
              parts[r].add(point, share * side.share, x, n_on_b);
        },
        state.layer_level(at(layer)), twist != nullptr ? &twists : nullptr);
  }
  const Pose X_ab = X_ba.inverse();
  const Vec3 own_a = own_origin(model, l.body_a), own_b = own_origin(model, l.body_b);
  LayerReport report;
  report.total = total.take(X_ab, own_a, own_b);
  for (Sum& part : parts) report.regions.push_back(part.take(X_ab, own_a, own_b));
  return report;
}

}  // namespace genu
