#include "genu/model/layer_report.h"

#include "genu/model/twist.h"

#include <algorithm>

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
    totals_.max_pressure = std::max(totals_.max_pressure, point.pressure);
    totals_.max_depth = std::max(totals_.max_depth, point.depth);
    totals_.most_used = std::max(totals_.most_used, point.used);
    totals_.centre += load * x;
    load_ += load;
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

}  // namespace

LayerReport report_layer(const JointModel& model, const std::vector<RegionDef>& regions, const State& state, int layer,
                         ElasticLayer::Memory& memory, const VecX* twist) {
  const auto& l = model.layers[at(layer)];
  Vec12 twists;
  if (twist != nullptr) twists << twist_of_body(model, l.body_a, *twist), twist_of_body(model, l.body_b, *twist);
  const Pose &X_Wa = state.poses[at(l.body_a)], &X_Wb = state.poses[at(l.body_b)];
  const Pose X_ba = X_Wb.inverse() * X_Wa;
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
          for (std::size_t r = 0; r < regions.size(); ++r)
            if (regions[r].contains(x)) parts[r].add(point, side.share, x, n_on_b);
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
