#include "genu/wrap/chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "genu/core/few.h"
#include "genu/wrap/tolerances.h"

namespace genu {
namespace {

/// The touching obstacles of a string and their arcs, side by side.
struct Touching {
  Few<Obstacle, kMostArcs> obstacles;
  Few<Geodesic, kMostArcs> arcs;
  Few<std::size_t, kMostArcs> index;

  Touching(std::span<const Obstacle> all, std::span<const Touch> touches) {
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (!touches[i].touching || arcs.full()) continue;
      obstacles.push_back(all[i]);
      arcs.push_back(touches[i].arc);
      index.push_back(i);
    }
  }
};

Vec3 in_body(const Obstacle& o, const Vec3& x) { return o.X_W.R.transpose() * (x - o.X_W.p); }

double clearance(const Obstacle& o, const Vec3& from, const Vec3& to) {
  double along = 0;
  return line_clearance(*o.surface, in_body(o, from), in_body(o, to), along);
}

/// Of a whole closed form of some extent: the middle between the feet of points far along its body's axes. Triangles
/// would show the same in a thousand times the time. `reach`: m, its size at most, roughly.
std::optional<Vec3> middle_of_feet(const Surface& surface, const Vec3& near, double reach) {
  if (!surface.is_global() || surface.is_unbounded() || std::isfinite(surface.edge_distance(near))) return std::nullopt;
  constexpr double kFeetFrom = 1e6;
  Vec3 low, high;
  for (int k = 0; k < 3; ++k) {
    SurfacePoint foot;
    const Vec3 away = kFeetFrom * reach * Vec3::Unit(k);
    if (!surface.project(near + away, foot)) return std::nullopt;
    high[k] = foot.p[k];
    if (!surface.project(near - away, foot)) return std::nullopt;
    low[k] = foot.p[k];
  }
  return Vec3(0.5 * (low + high));
}

/// The middle of an obstacle (in the world) near a line.
Vec3 middle_of(const Obstacle& o, const Vec3& from, const Vec3& to) {
  Vec3 half = 0.5 * (from + to);
  if (const auto shape = o.surface->round()) {
    const Vec3 centre = o.X_W * shape->centre, axis = o.X_W.R * shape->axis;
    return centre + axis.dot(half - centre) * axis;
  }
  const double reach = (to - from).norm();
  if (const auto middle = middle_of_feet(*o.surface, in_body(o, half), reach)) return o.X_W * *middle;
  const Mesh mesh = o.surface->triangles(reach / 8, in_body(o, half), reach);
  if (mesh.vertices.empty()) return half;
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& v : mesh.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  // Of a long bone the part beside the line.
  const Vec3 inside = in_body(o, half).cwiseMax(low).cwiseMin(high);
  const Vec3 centre = 0.5 * (low + high);
  return o.X_W * (o.surface->is_global() ? centre : inside);
}

class Chain {
 public:
  Chain(const std::vector<Vec3>& corners, int count, std::span<const Obstacle> obstacles) : obstacles_(obstacles) {
    std::vector<double> way(1, 0.0);
    for (std::size_t k = 1; k < corners.size(); ++k) way.push_back(way.back() + (corners[k] - corners[k - 1]).norm());
    std::size_t k = 1;
    for (int i = 0; i <= count; ++i) {
      const double s = way.back() * i / count;
      while (k + 1 < corners.size() && way[k] < s) ++k;
      const double u = (s - way[k - 1]) / std::max(way[k] - way[k - 1], 1e-300);
      nodes_.push_back(corners[k - 1] + std::min(u, 1.0) * (corners[k] - corners[k - 1]));
    }
    on_.assign(nodes_.size(), -1);
    clear_.resize(nodes_.size() * obstacles_.size());
  }

  void shorten() {
    const int rounds = kChainRounds * static_cast<int>(nodes_.size());
    for (int round = 0; round < rounds; ++round) {
      const double relaxation = 4 * round < 3 * rounds ? kChainRelaxation : 1;
      for (std::size_t i = 1; i + 1 < nodes_.size(); ++i) move(i, relaxation);
    }
  }

  /// The touches as the chain has them.
  std::vector<Touch> touches() const {
    std::vector<Touch> out(obstacles_.size());
    for (std::size_t o = 0; o < obstacles_.size();) {
      std::size_t last = o;  // of the names of one surface in a row
      while (last + 1 < obstacles_.size() && obstacles_[last + 1].surface == obstacles_[o].surface) ++last;
      const auto runs = runs_on(o, last);
      // Named once, it has one arc over all runs; named again, one for each, the last over the rest.
      for (std::size_t k = 0; k < runs.size() && o + k <= last; ++k)
        out[o + k] = touch_of(o + k, runs[k].first, o + k == last ? runs.back().second : runs[k].second);
      o = last + 1;
    }
    return out;
  }

 private:
  /// First and last nodes of each stretch on the obstacles from `first` to `last`.
  std::vector<std::pair<std::size_t, std::size_t>> runs_on(std::size_t first, std::size_t last) const {
    std::vector<std::pair<std::size_t, std::size_t>> runs;
    for (std::size_t i = 1; i + 1 < nodes_.size(); ++i) {
      if (on_[i] < static_cast<int>(first) || on_[i] > static_cast<int>(last)) continue;
      if (runs.empty() || runs.back().second + 1 < i)
        runs.emplace_back(i, i);
      else
        runs.back().second = i;
    }
    return runs;
  }

  Touch touch_of(std::size_t o, std::size_t first, std::size_t last) const {
    Touch touch;
    touch.touching = true;
    touch.arc.begin.p = in_body(obstacles_[o], nodes_[first]);
    const Vec3 ahead = nodes_[first + 1] - (last > first ? nodes_[first] : nodes_[first - 1]);
    touch.arc.begin.t = obstacles_[o].X_W.R.transpose() * ahead.normalized();
    double length = 0;
    for (std::size_t i = first; i < last; ++i) length += (nodes_[i + 1] - nodes_[i]).norm();
    touch.arc.length = length > 0 ? length : 0.25 * ahead.norm();
    return touch;
  }

  void move(std::size_t i, double relaxation) {
    const Vec3 old = nodes_[i];
    Vec3 x = old + relaxation * (0.5 * (nodes_[i - 1] + nodes_[i + 1]) - old);
    on_[i] = -1;
    for (std::size_t o = 0; o < obstacles_.size(); ++o) {
      const Obstacle& obstacle = obstacles_[o];
      const double most = kChainMove * obstacle.surface->smooth_length();
      if (const double moved = (x - old).norm(); moved > most) x = old + most / moved * (x - old);
      Clear& clear = clear_[i * obstacles_.size() + o];
      if ((x - clear.at).norm() < clear.by) continue;
      const Vec3 local = in_body(obstacle, x);
      const auto gap = obstacle.surface->gap(local);
      clear = {x, gap && obstacle.surface->knows_distance() ? *gap : 0};
      SurfacePoint foot;
      if (!gap || *gap > 0 || !obstacle.surface->project(local, foot)) continue;
      x = obstacle.X_W * foot.p;
      on_[i] = static_cast<int>(o);
    }
    nodes_[i] = x;
  }

  /// A ball (m, in the world) that is clear of an obstacle.
  struct Clear {
    Vec3 at = Vec3::Zero();
    double by = 0;
  };

  std::span<const Obstacle> obstacles_;
  std::vector<Vec3> nodes_;
  std::vector<int> on_;       ///< the obstacle that a node lies on, -1: none
  std::vector<Clear> clear_;  ///< of each node and obstacle
};

/// The corners of a chain that passes every obstacle on its side: as far out as it must be to be clear.
std::vector<Vec3> lifted(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                         const std::vector<Vec3>& sides) {
  std::vector<Vec3> corners{from};
  const double reach = (to - from).norm();
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Vec3 middle = middle_of(obstacles[i], from, to);
    Vec3 corner = middle;
    for (int k = obstacles[i].surface->gap(in_body(obstacles[i], middle)).value_or(-1) > 0 ? 0 : 1; k <= kLiftSteps;
         ++k) {
      corner = middle + sides[i] * (2 * reach * k / kLiftSteps);
      const double before = clearance(obstacles[i], corners.back(), corner),
                   after = clearance(obstacles[i], corner, to);
      if (before > 0 && (after > 0 || i + 1 < obstacles.size())) break;
    }
    corners.push_back(corner);
  }
  corners.push_back(to);
  return corners;
}

}  // namespace

bool solve_touches(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles, std::span<Touch> touches) {
  Touching now(obstacles, touches);
  if (now.arcs.empty()) return true;
  if (!solve_string(from, to, now.obstacles, now.arcs)) return false;
  for (std::size_t k = 0; k < now.arcs.size(); ++k) touches[now.index[k]].arc = now.arcs[k];
  return true;
}

double length_of(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                 std::span<const Touch> touches) {
  const Touching now(obstacles, touches);
  return string_length(from, to, now.obstacles, now.arcs);
}

double clearance_at(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                    std::span<const Touch> touches, std::size_t i, Geodesic& nearest) {
  Vec3 before = from, after = to;
  for (std::size_t k = 0; k < i; ++k)
    if (touches[k].touching) before = obstacles[k].X_W * touches[k].arc.end.p;
  for (std::size_t k = touches.size(); --k > i;)
    if (touches[k].touching) after = obstacles[k].X_W * touches[k].arc.begin.p;
  const Obstacle& o = obstacles[i];
  const Vec3 a = in_body(o, before), b = in_body(o, after);
  double along = 0;
  const double gap = line_clearance(*o.surface, a, b, along);
  nearest = Geodesic();
  nearest.begin.p = a + along * (b - a);
  nearest.begin.t = (b - a).normalized();
  return gap;
}

bool settle_touches(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles, std::span<Touch> touches) {
  for (int round = 0; round < 4 * static_cast<int>(touches.size()) + 2; ++round) {
    if (!solve_touches(from, to, obstacles, touches)) return false;
    bool changed = false;
    for (Touch& touch : touches) {
      if (!touch.touching || touch.arc.length >= 0) continue;
      touch.touching = false;
      changed = true;
    }
    for (std::size_t i = 0; i < touches.size() && !changed; ++i) {
      Geodesic nearest;
      if (touches[i].touching || !(clearance_at(from, to, obstacles, touches, i, nearest) < -kClearanceRounding))
        continue;
      touches[i] = {true, nearest};
      changed = true;
    }
    if (!changed) return true;
  }
  return false;
}

std::optional<std::vector<Touch>> first_string(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                                               std::span<const WrapSide> sides) {
  const Vec3 chord = (to - from).normalized();
  const Mat32 across = tangent_basis(chord);
  const bool free_choice = std::any_of(sides.begin(), sides.end(), [](const WrapSide& s) { return !s; });
  std::optional<std::vector<Touch>> best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < (free_choice ? kSidesTried : 1); ++k) {
    const double angle = 2 * EIGEN_PI * k / kSidesTried;
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < obstacles.size(); ++i)
      out.push_back(sides[i] ? Vec3((obstacles[i].X_W.R * *sides[i]).normalized())
                             : Vec3(across * Vec2(std::cos(angle), std::sin(angle))));
    const std::vector<Vec3> corners = lifted(from, to, obstacles, out);
    for (int doubling = 0; doubling <= kChainDoublings; ++doubling) {
      Chain chain(corners, kChainNodes << doubling, obstacles);
      chain.shorten();
      std::vector<Touch> touches = chain.touches();
      if (!settle_touches(from, to, obstacles, touches)) continue;
      const double length = length_of(from, to, obstacles, touches);
      if (length < least) least = length, best = std::move(touches);
      break;
    }
  }
  return best;
}

}  // namespace genu
