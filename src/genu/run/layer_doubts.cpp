#include "genu/run/layer_doubts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/contact/elastic_layer.h"

namespace genu {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double kMillimetre = 1e3;
constexpr double kNear = 2, kLeastNear = 5e-3;  // search depths, m: how far the other surface is looked for
constexpr std::size_t kMostRays = 4000;
constexpr std::size_t kNearest = 20;  // at least so many rays decide, or a tenth of those that meet something
constexpr double kMost = 0.75;        // of them
constexpr double kLeastShare = 1e-3;  // of a layer's load: less through the other body is not worth a word
constexpr double kClear = 1e-9;       // m: what touches at a ray's start is there, or not, for sure

/// One casting side of a layer at a pose.
struct Side {
  const JointModel::Layer& layer;
  const ElasticLayer::Side& side;
  const SurfaceDef &casting, &target;
  int body;
  Pose X_TC;

  Side(const Prepared& p, std::size_t k, std::size_t i, const State& state)
      : layer(p.model.layers[k]),
        side(layer.layer->sides()[i]),
        casting(p.scene.surfaces[at(side.a ? p.scene.layers[k].pair.surface_a : p.scene.layers[k].pair.surface_b)]),
        target(p.scene.surfaces[at(side.a ? p.scene.layers[k].pair.surface_b : p.scene.layers[k].pair.surface_a)]),
        body(side.a ? layer.body_a : layer.body_b),
        X_TC(state.poses[at(side.a ? layer.body_b : layer.body_a)].inverse() * state.poses[at(body)]) {}

  /// In the casting body as the file has it.
  std::string place(const JointModel& model, const Vec3& x) const {
    const Vec3 p = kMillimetre * (x - own_origin(model, body));
    return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", p[0], p[1], p[2]);
  }
};

struct Met {
  double distance;
  bool same;  ///< both normals to one side
  Vec3 x;
};

/// What a line through each casting triangle along its normal meets first of the other surface, ahead or behind.
std::vector<Met> meetings(const Side& s) {
  const double reach = std::max(kNear * s.layer.search_depth, kLeastNear);
  const TriangleTree& tree = s.side.quadrature->target();
  const std::vector<Ray> rays = s.side.quadrature->cell_rays();
  const std::size_t stride = 1 + rays.size() / kMostRays;
  std::vector<Met> out;
  for (std::size_t k = 0; k < rays.size(); k += stride) {
    const Vec3 x = s.X_TC * rays[k].origin, inward = s.X_TC.R * rays[k].direction;
    const auto nearer = [](const TriangleTree::Hit& p, const TriangleTree::Hit& q) {
      return !q || (p && p.distance < q.distance) ? p : q;
    };
    // A little from behind, so that faces that touch are met.
    const Vec3 under = x + kClear * inward, over = x - kClear * inward;
    const auto opposed = nearer(tree.entering(under, -inward, reach), tree.leaving(over, inward, reach));
    const auto same = nearer(tree.leaving(under, -inward, reach), tree.entering(over, inward, reach));
    if (!opposed && !same) continue;
    const bool as_one = same && (!opposed || same.distance < opposed.distance);
    out.push_back({as_one ? same.distance : opposed.distance, as_one, rays[k].origin});
  }
  return out;
}

}  // namespace

std::vector<std::string> facing_doubts(const Prepared& prepared, const std::vector<const State*>& states) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < prepared.model.layers.size(); ++k)
    for (const State* state : states) {
      const Side side(prepared, k, 0, *state);
      std::vector<Met> met = meetings(side);
      if (met.size() < kNearest) continue;
      const std::size_t nearest = std::max(kNearest, met.size() / 10);
      std::stable_sort(met.begin(), met.end(), [](const Met& a, const Met& b) { return a.distance < b.distance; });
      met.resize(nearest);
      const auto same = std::count_if(met.begin(), met.end(), [](const Met& m) { return m.same; });
      if (static_cast<double>(same) > kMost * static_cast<double>(nearest)) {
        const auto first = std::find_if(met.begin(), met.end(), [](const Met& m) { return m.same; });
        out.push_back(fmt::format(
            "The surfaces of {} face the same way where they are nearest: so do {} of the {} nearest triangles of {} "
            "and "
            "what they have of {} before them, the first at {} of the former. One of the two is inside out (inside = "
            "true turns it round) or the wrong side of a shell: they do not press against each other.",
            side.layer.name, same, nearest, side.casting.name, side.target.name, side.place(prepared.model, first->x)));
      }
      break;
    }
  return out;
}

std::vector<std::string> reach_doubts(const Prepared& prepared, const std::vector<const State*>& states) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < prepared.model.layers.size(); ++k) {
    double worst = 0;
    std::string said;
    for (std::size_t i = 0; i < prepared.model.layers[k].layer->sides().size(); ++i) {
      ElasticLayer::Memory memory;
      for (const State* state : states) {
        const Side side(prepared, k, i, *state);
        const TriangleTree& tree = side.side.quadrature->target();
        double load = 0, through = 0, deepest = 0;
        int points = 0, wrong = 0;
        Vec3 place = Vec3::Zero();
        const auto look = [&](const LayerPoint& point) {
          if (point.area == 0) return;
          ++points;
          load += point.load;
          const Vec3 inward = -(side.X_TC.R * point.n);
          if (!tree.entering(side.X_TC * point.x + kClear * inward, inward, point.depth - 2 * kClear)) return;
          ++wrong;
          through += point.load;
          if (point.depth > deepest) deepest = point.depth, place = point.x;
        };
        side.layer.layer->visit(state->poses[at(side.layer.body_a)], state->poses[at(side.layer.body_b)], i, memory,
                                look, state->layer_level(k));
        if (!(through > kLeastShare * load) || through <= worst) continue;
        worst = through;
        said = fmt::format(
            "The rays of {} reach through {}: {} of {} triangles of {} that carry load, and {:.3g} of {:.3g} N, enter "
            "it "
            "before they leave it, the longest over {:.2f} mm from {}. That is no overlap but something thinner than "
            "`search_depth` ({:.3g} mm): give a smaller one, or a mesh of the side in contact alone.",
            side.layer.name, side.target.name, wrong, points, side.casting.name, through, load, kMillimetre * deepest,
            side.place(prepared.model, place), kMillimetre * side.layer.search_depth);
      }
    }
    if (!said.empty()) out.push_back(said);
  }
  return out;
}

}  // namespace genu
