#include "genu/model/ligament_path.h"

#include <algorithm>
#include <limits>

#include <Eigen/LU>

#include "genu/core/few.h"
#include "genu/model/two_body_scatter.h"

namespace genu {
namespace {

using Point = LigamentPath::Point;

/// Calls f(moving body, wrench of unit tension) for every end of every line with variable length.
template <typename F>
void for_each_pull(const LigamentPath& path, const std::vector<Pose>& poses, const Wraps& wraps, double tension,
                   const F& f) {
  TwoBodyWrench pull;
  path.for_each_line(wraps, [&](const Point& a, const Point& b, const TautLine& line) {
    if (a.moving == b.moving) return;
    line.evaluate_wrench(poses[at(a.body)], poses[at(b.body)], tension, pull);
    if (a.moving >= 0) f(a.moving, pull.on_a);
    if (b.moving >= 0) f(b.moving, pull.on_b);
  });
}

}  // namespace

/// The way between two neighbouring points with obstacles between them, in the world.
struct LigamentPath::Span {
  std::size_t point = 0;  ///< the first of the two
  Vec3 from, to;
  std::size_t first = 0;  ///< obstacle
  Few<genu::Obstacle, kMostArcs> places;
  Few<Touch, kMostArcs> touches;
};

template <typename F>
void LigamentPath::for_each_span(const F& f) const {
  for (std::size_t i = 0; i < obstacles_.size();) {
    std::size_t end = i;
    while (end < obstacles_.size() && obstacles_[end].after == obstacles_[i].after) ++end;
    f(i, end);
    i = end;
  }
}

LigamentPath::Span LigamentPath::span_at(const std::vector<Pose>& poses, const Wraps& wraps, std::size_t first) const {
  Span span;
  span.point = at(obstacles_[first].after);
  const Point &a = points_[span.point], &b = points_[span.point + 1];
  span.from = poses[at(a.body)] * a.p;
  span.to = poses[at(b.body)] * b.p;
  span.first = first;
  for (std::size_t i = first; i < obstacles_.size() && obstacles_[i].after == obstacles_[first].after; ++i) {
    span.places.push_back({obstacles_[i].surface.get(), poses[at(obstacles_[i].body)]});
    span.touches.push_back(wraps.empty() ? Touch() : static_cast<const Touch&>(wraps[first_ + i]));
  }
  return span;
}

void LigamentPath::set_obstacles(std::vector<Obstacle> obstacles, std::size_t first) {
  obstacles_ = std::move(obstacles);
  first_ = first;
}

void LigamentPath::move_with(const std::vector<int>& moving) {
  for (Point& point : points_) point.moving = moving[at(point.body)];
  for (Obstacle& obstacle : obstacles_) obstacle.moving = moving[at(obstacle.body)];
}

std::vector<LigamentPath::Inside> LigamentPath::points_inside(const std::vector<Pose>& poses) const {
  std::vector<Inside> out;
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const Obstacle& o = obstacles_[i];
    for (const std::size_t k : {at(o.after), at(o.after) + 1}) {
      const Vec3 x = poses[at(o.body)].inverse() * (poses[at(points_[k].body)] * points_[k].p);
      const auto gap = o.surface->gap(x);
      if (gap && *gap < 0) out.push_back({i, k, -*gap});
    }
  }
  return out;
}

bool LigamentPath::find_touches(const std::vector<Pose>& poses, Wraps& wraps) const {
  if (obstacles_.empty()) return true;
  const std::vector<Inside> inside = points_inside(poses);
  bool good = true;
  for_each_span([&](std::size_t first, std::size_t end) {
    const Span span = span_at(poses, wraps, first);
    std::vector<genu::Obstacle> places;
    std::vector<WrapSide> sides;
    std::vector<std::size_t> kept;
    for (std::size_t i = first; i < end; ++i) {
      wraps[first_ + i] = {};
      const bool passed = obstacles_[i].ignore_inside &&
                          std::any_of(inside.begin(), inside.end(), [&](const Inside& x) { return x.obstacle == i; });
      if (passed) continue;
      places.push_back(span.places[i - first]);
      sides.push_back(obstacles_[i].side);
      kept.push_back(i);
    }
    if (kept.empty()) return;
    const auto found = first_string(span.from, span.to, places, sides);
    good = good && found;
    for (std::size_t k = 0; found && k < kept.size(); ++k) {
      static_cast<Touch&>(wraps[first_ + kept[k]]) = (*found)[k];
    }
  });
  return good;
}

bool LigamentPath::follow_touches(const std::vector<Pose>& poses, Wraps& wraps) const {
  bool good = true;
  for_each_span([&](std::size_t first, std::size_t end) {
    if (!good) return;
    Span span = span_at(poses, wraps, first);
    // An obstacle that a path passes through takes no part.
    Few<std::size_t, kMostArcs> kept;
    for (std::size_t i = first; i < end; ++i) {
      bool through = false;
      if (obstacles_[i].ignore_inside) {
        const genu::Obstacle& o = span.places[i - first];
        for (const Vec3* x : {&span.from, &span.to}) {
          const auto gap = o.surface->gap(o.X_W.inverse() * *x);
          through = through || (gap && *gap < 0);
        }
      }
      if (through) {
        wraps[first_ + i].touching = false;
        continue;
      }
      span.places[kept.size()] = span.places[i - first];
      span.touches[kept.size()] = span.touches[i - first];
      kept.push_back(i);
    }
    if (kept.empty()) return;
    span.places.resize(kept.size());
    span.touches.resize(kept.size());
    const bool by_length = wraps[first_ + kept[0]].by_length;
    good = by_length ? settle_touches(span.from, span.to, span.places, span.touches)
                     : solve_touches(span.from, span.to, span.places, span.touches);
    for (std::size_t k = 0; good && k < kept.size(); ++k)
      static_cast<Touch&>(wraps[first_ + kept[k]]) = span.touches[k];
  });
  return good;
}

double LigamentPath::touch_margin(const std::vector<Pose>& poses, const Wraps& wraps, std::size_t i) const {
  const WrapTouch& touch = wraps[first_ + i];
  if (touch.touching) return touch.arc.length;
  std::size_t first = i;
  while (first > 0 && obstacles_[first - 1].after == obstacles_[i].after) --first;
  const Span span = span_at(poses, wraps, first);
  if (obstacles_[i].ignore_inside)
    for (const Vec3* x : {&span.from, &span.to}) {
      const genu::Obstacle& o = span.places[i - first];
      const auto gap = o.surface->gap(o.X_W.inverse() * *x);
      if (gap && *gap < 0) return std::numeric_limits<double>::infinity();
    }
  Geodesic nearest;
  return clearance_at(span.from, span.to, span.places, span.touches, i - first, nearest);
}

void LigamentPath::switch_touch(const std::vector<Pose>& poses, Wraps& wraps, std::size_t i) const {
  WrapTouch& touch = wraps[first_ + i];
  if (touch.touching) {
    touch.touching = false;
    return;
  }
  std::size_t first = i;
  while (first > 0 && obstacles_[first - 1].after == obstacles_[i].after) --first;
  const Span span = span_at(poses, wraps, first);
  clearance_at(span.from, span.to, span.places, span.touches, i - first, touch.arc);
  touch.touching = true;
  if (!follow_touches(poses, wraps)) touch.touching = false;
}

double LigamentPath::length(const std::vector<Pose>& poses, const Wraps& wraps) const {
  double length = 0;
  for_each_line(wraps, [&](const Point& a, const Point& b, const TautLine& line) {
    length += line.length(poses[at(a.body)], poses[at(b.body)]);
  });
  for (std::size_t i = 0; i < obstacles_.size(); ++i) length += arc_length(wraps, i);
  return length;
}

double LigamentPath::length_rate(const std::vector<Pose>& poses, const VecX& twist, const Wraps& wraps) const {
  double rate = 0;
  for_each_pull(*this, poses, wraps, 1,
                [&](int body, const Vec6& pull) { rate -= pull.dot(twist.segment<6>(6 * body)); });
  return rate;
}

VecX LigamentPath::length_gradient(const std::vector<Pose>& poses, int moving_count, const Wraps& wraps) const {
  VecX out = VecX::Zero(6 * moving_count);
  for_each_pull(*this, poses, wraps, 1, [&](int body, const Vec6& pull) { out.segment<6>(6 * body) -= pull; });
  return out;
}

void LigamentPath::add_tension(const std::vector<Pose>& poses, double tension, VecX& wrench, const Wraps& wraps) const {
  for_each_pull(*this, poses, wraps, tension, [&](int body, const Vec6& pull) { wrench.segment<6>(6 * body) += pull; });
}

/// The moves of the touching points of one span, and what they do to the pull of unit tension on its bodies.
struct LigamentPath::Variation {
  StringHessian hessian;
  Few<Geodesic, kMostArcs> arcs;
  Few<genu::Obstacle, kMostArcs> places;
  Few<std::size_t, kMostArcs> obstacle;
  Few<int, kMostArcs + 2> moving;  ///< bodies whose pull changes
  /// Of each of them, by the two moves of each arc.
  using Moves = std::array<Eigen::Matrix<double, 6, 2>, kMostArcs>;
  std::array<Moves, kMostArcs + 2> pull;

  Variation(const LigamentPath& path, const std::vector<Pose>& poses, const Span& span) {
    for (std::size_t i = 0; i < span.places.size(); ++i) {
      if (!span.touches[i].touching) continue;
      arcs.push_back(span.touches[i].arc);
      places.push_back(span.places[i]);
      obstacle.push_back(span.first + i);
    }
    if (arcs.empty()) return;
    string_hessian(span.from, span.to, places, arcs, hessian);
    for_each_leg(path, span, [&](const End& x, const End& y) { add_leg(poses, x, y); });
  }

  /// H^-1.
  StringHessian::Matrix inverse() const {
    if (arcs.size() > 1) return hessian.H.partialPivLu().inverse();
    const Mat2 H = hessian.H;
    return H.inverse();
  }

  /// An end of a leg: on a point, or on arc `arc`.
  struct End {
    Point point;
    int arc = -1;
    bool at_end = false;
    Vec3 place, b;
  };

  template <typename F>
  void for_each_leg(const LigamentPath& path, const Span& span, const F& f) const {
    End last{path.points_[span.point], -1, false, span.from, Vec3::Zero()};
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const LigamentPath::Obstacle& o = path.obstacles_[obstacle[i]];
      const auto end = [&](const ArcEnd& e, bool at_end) {
        return End{{o.body, e.p, o.moving, -1 - static_cast<int>(obstacle[i])},
                   static_cast<int>(i),
                   at_end,
                   places[i].X_W * e.p,
                   places[i].X_W.R * e.b()};
      };
      f(last, end(arcs[i].begin, false));
      last = end(arcs[i].end, true);
    }
    f(last, End{path.points_[span.point + 1], -1, false, span.to, Vec3::Zero()});
  }

  const Vec2& move(const End& end) const {
    return end.at_end ? hessian.at_end[at(end.arc)] : hessian.at_begin[at(end.arc)];
  }

  /// Adds tension (dP/dz) H^-1 (dP/dz)^T.
  void add_stiffness(double tension, MatX& stiffness) const {
    const StringHessian::Matrix held = tension * inverse();
    for (std::size_t i = 0; i < moving.size(); ++i)
      for (std::size_t k = 0; k < arcs.size(); ++k)
        for (std::size_t l = 0; l < arcs.size(); ++l) {
          const Mat2 kl = held.block<2, 2>(static_cast<Eigen::Index>(2 * k), static_cast<Eigen::Index>(2 * l));
          const Eigen::Matrix<double, 6, 2> moved = pull[i][k] * kl;
          for (std::size_t j = 0; j < moving.size(); ++j)
            stiffness.block<6, 6>(6 * moving[i], 6 * moving[j]) += moved * pull[j][l].transpose();
        }
  }

  Moves& pull_of(int body) {
    std::size_t i = 0;
    while (i < moving.size() && moving[i] != body) ++i;
    if (i == moving.size()) {
      moving.push_back(body);
      for (std::size_t k = 0; k < arcs.size(); ++k) pull[i][k].setZero();
    }
    return pull[i];
  }

  void add_leg(const std::vector<Pose>& poses, const End& x, const End& y) {
    if (x.point.moving == y.point.moving) return;
    const Vec3 d = y.place - x.place;
    const double length = d.norm();
    const Vec3 e = d / length;
    for (const End* tip : {&x, &y}) {
      if (tip->arc < 0) continue;
      const double sign = tip == &y ? 1 : -1;
      const Vec3 turn = sign / length * tip->b;  // of e, when the tip moves along b by 1
      for (const End* end : {&x, &y}) {
        if (end->point.moving < 0) continue;
        const double side = end == &x ? 1 : -1;  // e on the body of x, -e on that of y
        const Vec3 arm = poses[at(end->point.body)].R * end->point.p;
        Vec6 change;
        change << side * turn, side * arm.cross(turn);
        if (end == tip) change.tail<3>() += side * tip->b.cross(e);
        pull_of(end->point.moving)[at(tip->arc)] += change * move(*tip).transpose();
      }
    }
  }
};

void LigamentPath::linearize(const std::vector<Pose>& poses, const LawValue& tension, VecX& gradient, VecX& wrench,
                             MatX* stiffness, const Wraps& wraps) const {
  TwoBodyWrench pull;
  gradient.setZero(wrench.size());
  for_each_line(wraps, [&](const Point& a, const Point& b, const TautLine& line) {
    if (a.moving == b.moving) return;  // its length is constant
    const TwoBodyScatter scatter(a.moving, b.moving);
    const Pose &X_WA = poses[at(a.body)], &X_WB = poses[at(b.body)];
    stiffness != nullptr ? line.evaluate(X_WA, X_WB, 1, 0, pull, scatter.which_move())
                         : line.evaluate_wrench(X_WA, X_WB, 1, pull, scatter.which_move());
    scatter.add_wrench(-pull.on_a, -pull.on_b, gradient);
    if (stiffness == nullptr) return;
    pull.stiffness *= tension.force;
    scatter.add_stiffness(pull.stiffness, *stiffness);
  });
  wrench -= tension.force * gradient;
  if (stiffness == nullptr) return;
  if (tension.force != 0)
    for_each_span([&](std::size_t first, std::size_t) {
      const Variation v(*this, poses, span_at(poses, wraps, first));
      if (!v.arcs.empty()) v.add_stiffness(tension.force, *stiffness);
    });
  if (tension.stiffness == 0) return;
  for (Eigen::Index j = 0; j < stiffness->cols(); ++j)
    if (gradient[j] != 0) stiffness->col(j) -= tension.stiffness * gradient[j] * gradient;
}

void LigamentPath::add_touch_rate(const std::vector<Pose>& poses, const Wraps& wraps, const Change& change,
                                  double tension, VecX& wrench) const {
  for_each_span([&](std::size_t first, std::size_t) {
    const Span span = span_at(poses, wraps, first);
    const Variation v(*this, poses, span);
    if (v.arcs.empty()) return;
    // d(dL/dz): of each leg, how its direction turns across the moves of its tips; of each arc, how its end turns.
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * kMostArcs, 1> rate =
        Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * kMostArcs, 1>::Zero(
            static_cast<Eigen::Index>(2 * v.arcs.size()));
    v.for_each_leg(*this, span, [&](const Variation::End& x, const Variation::End& y) {
      const auto velocity = [&](const Variation::End& end, std::size_t point) -> const Vec3& {
        if (end.arc < 0) return change.points[point];
        const ArcChange& arc = change.arcs[v.obstacle[at(end.arc)]];
        return end.at_end ? arc.end : arc.begin;
      };
      const Vec3 moved = velocity(y, span.point + 1) - velocity(x, span.point);
      const double length = (y.place - x.place).norm();
      for (const Variation::End* tip : {&x, &y})
        if (tip->arc >= 0)
          rate.segment<2>(2 * tip->arc) += (tip == &y ? 1 : -1) / length * tip->b.dot(moved) * v.move(*tip);
      if (x.arc >= 0) rate.segment<2>(2 * x.arc) += change.arcs[v.obstacle[at(x.arc)]].turn * v.move(x);
    });
    const VecX moves = -tension * (v.inverse() * rate);
    for (std::size_t i = 0; i < v.moving.size(); ++i)
      for (std::size_t k = 0; k < v.arcs.size(); ++k)
        wrench.segment<6>(6 * v.moving[i]) += v.pull[i][k] * moves.segment<2>(static_cast<Eigen::Index>(2 * k));
  });
}

double LigamentPath::hold(const std::vector<Pose>& poses, const Wraps& wraps) const {
  double least = 1;
  for_each_span([&](std::size_t first, std::size_t) {
    const Variation v(*this, poses, span_at(poses, wraps, first));
    if (!v.arcs.empty()) least = std::min(least, least_hold(v.hessian));
  });
  return least;
}

bool LigamentPath::is_shortest(const std::vector<Pose>& poses, const Wraps& wraps) const {
  bool shortest = true;
  for_each_span([&](std::size_t first, std::size_t) {
    const Variation v(*this, poses, span_at(poses, wraps, first));
    if (!v.arcs.empty()) shortest = shortest && is_shortest_nearby(v.hessian, v.arcs);
  });
  return shortest;
}

}  // namespace genu
