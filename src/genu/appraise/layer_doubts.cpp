#include "genu/appraise/layer_doubts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/appraise/tolerances.h"
#include "genu/contact/elastic_layer.h"
#include "genu/core/units.h"
#include "genu/model/layer_levels.h"

namespace genu {
namespace {

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
    const Vec3 p = to::kMillimetre * (x - own_origin(model, body));
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
  const double reach = std::max(kRaySearch * s.layer.search_depth, kMinRaySearch);
  const TriangleTree& tree = s.side.quadrature->target();
  const std::vector<Ray> rays = s.side.quadrature->cell_rays();
  const std::size_t stride = 1 + rays.size() / kMaxDoubtRays;
  std::vector<Met> out;
  for (std::size_t k = 0; k < rays.size(); k += stride) {
    const Vec3 x = s.X_TC * rays[k].origin, inward = s.X_TC.R * rays[k].direction;
    const auto nearer = [](const TriangleTree::Hit& p, const TriangleTree::Hit& q) {
      return !q || (p && p.distance < q.distance) ? p : q;
    };
    // A little from behind, so that faces that touch are met.
    const Vec3 under = x + kClearStart * inward, over = x - kClearStart * inward;
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
      if (met.size() < kMinDeciding) continue;
      const std::size_t nearest = std::max(kMinDeciding, met.size() / 10);
      std::stable_sort(met.begin(), met.end(), [](const Met& a, const Met& b) { return a.distance < b.distance; });
      met.resize(nearest);
      const auto same = std::count_if(met.begin(), met.end(), [](const Met& m) { return m.same; });
      if (static_cast<double>(same) > kDecidingShare * static_cast<double>(nearest)) {
        const auto first = std::find_if(met.begin(), met.end(), [](const Met& m) { return m.same; });
        out.push_back(fmt::format(
            "The surfaces of {} face the same way where they are nearest, so they cannot press on each other: {} of "
            "the "
            "{} nearest triangles of {} and the part of {} in front of them, first at {} of the former. One of the two "
            "is inside out (set inside = true), or is the wrong side of a shell.",
            side.layer.name, same, nearest, side.casting.name, side.target.name, side.place(prepared.model, first->x)));
      }
      break;
    }
  return out;
}

namespace {

/// Casting triangles that have gone through the whole of the other body at a pose.
struct Passed {
  int points = 0, loaded = 0;
  double deepest = 0;  ///< m: farthest beyond the other body's back
  Vec3 place = Vec3::Zero();
};

/// A ray that enters the other body and leaves it before it leaves its own: its start is beyond the back of the other.
/// (From the back of a shell it leaves that shell first.)
Passed passed_through(const Side& s, const TriangleTree& own) {
  const TriangleTree& tree = s.side.quadrature->target();
  const std::vector<Ray> rays = s.side.quadrature->cell_rays();
  const std::size_t stride = 1 + rays.size() / kMaxDoubtRays;
  Passed out;
  for (std::size_t k = 0; k < rays.size(); k += stride) {
    const Vec3 x = s.X_TC * rays[k].origin, inward = s.X_TC.R * rays[k].direction;
    const auto leave = tree.leaving(x, inward, s.layer.search_depth);
    if (!leave) continue;
    const auto enter = tree.entering(x, inward, leave.distance);
    const Vec3 under = rays[k].origin + kClearStart * rays[k].direction;
    if (!enter) {
      ++out.loaded;
    } else if (!own.leaving(under, rays[k].direction, leave.distance)) {
      ++out.points;
      if (enter.distance > out.deepest) out.deepest = enter.distance, out.place = rays[k].origin;
    }
  }
  return out;
}

}  // namespace

std::vector<std::string> passed_doubts(const Prepared& prepared, const std::vector<const State*>& states) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < prepared.model.layers.size(); ++k) {
    const ElasticLayer& layer = *prepared.model.layers[k].layer;
    if (layer.buried() == nullptr) continue;
    double worst = 0;
    std::string said;
    for (std::size_t i = 0; i < layer.sides().size(); ++i)
      for (const State* state : states) {
        const Side side(prepared, k, i, *state);
        const Passed passed = passed_through(side, layer.buried()->triangles(side.side.a));
        if (!(passed.points > kPassedShare * passed.loaded) || passed.deepest <= worst) continue;
        worst = passed.deepest;
        said = fmt::format(
            "{} of the triangles of {} have gone through {}, by up to {:.2f} mm at {}. They carry no load there: the "
            "body is thinner than the overlap. Use a mesh of its contact side alone, or of the whole bone.",
            passed.points, side.casting.name, side.target.name, to::kMillimetre * passed.deepest,
            side.place(prepared.model, passed.place));
      }
    if (!said.empty()) out.push_back(fmt::format("Layer {}: {}", prepared.model.layers[k].name, said));
  }
  return out;
}

namespace {

/// Of a layer in one row, what lies on ground that is less sure.
struct Footing {
  double peak = 0, at_rim[2] = {0, 0};  ///< Pa: anywhere, at the rim of its first and second surface
  double load = 0, guessed = 0;         ///< N: all of it, on thickness that was filled in
};

bool has_rim(const Surface& surface) { return std::isfinite(surface.edge_distance(Vec3::Zero())); }

Footing footing(const Prepared& prepared, std::size_t k, const State& state, ElasticLayer::Memory& memory) {
  const JointModel::Layer& layer = prepared.model.layers[k];
  Footing out;
  for (std::size_t i = 0; i < layer.layer->sides().size(); ++i) {
    const Side s(prepared, k, i, state);
    const auto look = [&](const LayerPoint& point) {
      out.peak = std::max(out.peak, point.pressure);
      if (!(point.area > 0)) return;
      out.load += s.side.share * point.load;
      if (point.guessed) out.guessed += s.side.share * point.load;
      const double cell = kRimCell * std::sqrt(point.area);
      const Vec3 met = s.X_TC * (point.x - point.depth * point.n);
      const Vec3 &on_a = s.side.a ? point.x : met, &on_b = s.side.a ? met : point.x;
      if (layer.a->edge_distance(on_a) < cell) out.at_rim[0] = std::max(out.at_rim[0], point.pressure);
      if (layer.b->edge_distance(on_b) < cell) out.at_rim[1] = std::max(out.at_rim[1], point.pressure);
    };
    layer.layer->visit(state.poses[at(layer.body_a)], state.poses[at(layer.body_b)], i, memory, look,
                       state.layer_level(k));
  }
  return out;
}

/// The rows where something is so, and where it is worst.
struct Rows {
  std::vector<std::size_t> rows;  ///< from 1
  std::size_t worst = 0;
  double most = 0, of = 0;

  void add(std::size_t row, double value, double all) {
    if (rows.empty() || value / all > most / of) worst = row, most = value, of = all;
    rows.push_back(row);
  }
  /// "row 3", "rows 3, 4 and 9", "rows 3 to 40 (27 of them)"
  std::string text() const {
    constexpr std::size_t kRowsNamed = 4;
    if (rows.size() == 1) return fmt::format("row {}", rows[0]);
    if (rows.size() > kRowsNamed)
      return fmt::format("rows {} to {} ({} of them)", rows.front(), rows.back(), rows.size());
    std::string out = "rows ";
    for (std::size_t i = 0; i < rows.size(); ++i)
      out += fmt::format("{}{}", i == 0 ? "" : i + 1 == rows.size() ? " and " : ", ", rows[i]);
    return out;
  }
};

/// Of one layer in all of its rows.
struct Footings {
  Rows rim[2], guessed;

  Footings(const Prepared& prepared, std::size_t k, const std::vector<PoseRecord>& records) {
    ElasticLayer::Memory memory;
    const std::size_t stride = 1 + (records.empty() ? 0 : (records.size() - 1) / kMaxDoubtRows);
    for (std::size_t row = 0; row < records.size(); row += stride) {
      const State& state = records[row].point.pose.state;
      if (state.poses.empty()) continue;
      const Footing found = footing(prepared, k, state, memory);
      for (std::size_t i = 0; i < 2; ++i)
        if (found.at_rim[i] > kReportedShare * found.peak) rim[i].add(row + 1, found.at_rim[i], found.peak);
      if (found.guessed > kReportedShare * found.load) guessed.add(row + 1, found.guessed, found.load);
    }
  }
};

}  // namespace

std::vector<std::string> footing_doubts(const Prepared& prepared, const std::vector<PoseRecord>& records) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < prepared.model.layers.size(); ++k) {
    const JointModel::Layer& layer = prepared.model.layers[k];
    const LayerDef& def = prepared.scene.layers[k];
    if (!def.measured && !has_rim(*layer.a) && !has_rim(*layer.b)) continue;
    const Footings found(prepared, k, records);
    for (std::size_t i = 0; i < 2; ++i) {
      const Rows& rim = found.rim[i];
      if (rim.rows.empty()) continue;
      const SurfaceDef& surface = prepared.scene.surfaces[at(i == 0 ? def.pair.surface_a : def.pair.surface_b)];
      out.push_back(fmt::format(
          "The contact area of {} reaches the rim of {}surface {} in {}. The pressure is cut off there, at {:.3g} MPa "
          "of at most {:.3g} MPa in row {}. Use a larger {}.",
          layer.name, surface.patch ? "the patch of " : "", surface.name, rim.text(), 1e-6 * rim.most, 1e-6 * rim.of,
          rim.worst, surface.patch ? "patch" : "mesh"));
    }
    if (const Rows& guessed = found.guessed; !guessed.rows.empty())
      out.push_back(fmt::format(
          "The contact of {} loads cartilage without bone under it, whose thickness is extrapolated, in {}: {:.3g} of "
          "{:.3g} N in row {}.",
          layer.name, guessed.text(), guessed.most, guessed.of, guessed.worst));
  }
  return out;
}

std::vector<std::string> tolerance_doubts(const Prepared& prepared, const std::vector<PoseRecord>& records) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < prepared.model.layers.size(); ++k) {
    const JointModel::Layer& layer = prepared.model.layers[k];
    const LayerDef& def = prepared.scene.layers[k];
    if (!(layer.tolerance > 0)) continue;
    Rows missed;
    ElasticLayer::Memory memory;
    LayerWrench pressed;
    const std::size_t stride = 1 + (records.empty() ? 0 : (records.size() - 1) / kMaxDoubtRows);
    for (std::size_t row = 0; row < records.size(); row += stride) {
      const State& state = records[row].point.pose.state;
      if (state.poses.empty() || state.layer_level(k) < layer.most_level) continue;
      layer.layer->evaluate(state.poses[at(layer.body_a)], state.poses[at(layer.body_b)], memory, pressed,
                            layer.most_level, nullptr);
      const double allowed = allowed_error(prepared.model, k, pressed.load);
      if (pressed.error > kMissedTolerance * allowed) missed.add(row + 1, pressed.error, allowed / layer.tolerance);
    }
    if (!missed.rows.empty())
      out.push_back(fmt::format(
          "The force of the layer of {} misses its tolerance of {:.0e} in {}: it may err by {:.2g} % in row "
          "{}. Its triangles are too coarse for so small a contact area. {}",
          layer.name, layer.tolerance, missed.text(), 100 * missed.most / missed.of, missed.worst,
          def.modulus > kStiffLayer ? "A layer of this `modulus` is all but rigid: use model = \"rigid\"."
                                    : "Use finer meshes."));
  }
  return out;
}

}  // namespace genu
