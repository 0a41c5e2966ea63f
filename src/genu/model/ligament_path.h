// The path of a ligament or cable: from point to point over the bodies, straight where it is free and along the
// surfaces it wraps round where it touches them (wrap/taut_string.h), under one tension.
//
// L is the length of its lines and arcs, g = dL/dX its gradient with respect to the twists of the moving bodies. L is
// stationary in the touching points, so g is that of the lines, as if these points were fixed to their bodies. A
// tension T exerts the wrench -T g; with T = T(L) its stiffness is -T' g g^T - T dg/dX. With P = -g, and moves z of the
// touching points across the path (StringHessian),
//
//   dP/dX = (dP/dX at fixed touching points) + (dP/dz) H^-1 (dP/dz)^T
//
// Laws, dampers, events, sensitivities and drawings use only the interface below.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "genu/core/pose.h"
#include "genu/core/types.h"
#include "genu/model/ligament.h"
#include "genu/wrap/arc_change.h"
#include "genu/wrap/chain.h"

namespace genu {

/// What a path does at one of its obstacles: part of a state, like the coordinates that belong to its poses.
struct WrapTouch : Touch {
  /// Whether the path touches follows from its lengths at each pose; else it stays as it is, and the length continues
  /// smoothly beyond the pose where it begins to touch or leaves.
  bool by_length = false;
};
using Wraps = std::vector<WrapTouch>;

class LigamentPath {
 public:
  struct Point {
    int body = 0;
    Vec3 p = Vec3::Zero();  ///< m, in the body
    int moving = -1;        ///< index of the body among the moving ones; -1: fixed. Set by move_with()
    int index = 0;          ///< of the points from end to end; -1 - i: it touches obstacle i
  };
  /// A surface that it wraps round.
  struct Obstacle {
    std::string name;  ///< of the surface
    int body = 0;
    std::shared_ptr<const Surface> surface;
    int after = 0;  ///< it lies between points `after` and `after` + 1
    WrapSide side = {};
    bool ignore_inside = false;  ///< with an end inside it, the path passes through it
    int moving = -1;
  };

  LigamentPath() = default;
  /// Points in order from end to end; at least two.
  explicit LigamentPath(std::vector<Point> points) : points_(std::move(points)) {
    for (std::size_t k = 0; k < points_.size(); ++k) points_[k].index = static_cast<int>(k);
  }

  const std::vector<Point>& points() const { return points_; }
  const Point& from() const { return points_.front(); }
  const Point& to() const { return points_.back(); }
  /// Whether there is only one line.
  bool is_straight() const { return points_.size() == 2 && obstacles_.empty(); }

  /// Obstacles in order, whose touches are those from `first` on in the Wraps of the calls below.
  void set_obstacles(std::vector<Obstacle> obstacles, std::size_t first);
  const std::vector<Obstacle>& obstacles() const { return obstacles_; }
  /// Index of the touch of obstacle `i` in Wraps.
  std::size_t touch_index(std::size_t i) const { return first_ + i; }

  /// Moves point k on its body (m).
  void set_point(std::size_t k, const Vec3& p) { points_[k].p = p; }

  /// `moving[i]`: the index of body i among the moving ones, -1 where it is fixed.
  void move_with(const std::vector<int>& moving);

  /// Finds the touches from nothing. False where no path is found. Allocates.
  [[nodiscard]] bool find_touches(const std::vector<Pose>& poses, Wraps& wraps) const;

  /// Carries the touches on to other poses. False where that fails.
  [[nodiscard]] bool follow_touches(const std::vector<Pose>& poses, Wraps& wraps) const;

  /// m: how far obstacle i is from changing between touching and free; negative: it has to. The length of the arc, or
  /// the clearance of the line.
  double touch_margin(const std::vector<Pose>& poses, const Wraps& wraps, std::size_t i) const;

  /// Whether the touching path is a strict local minimum of its length.
  bool is_shortest(const std::vector<Pose>& poses, const Wraps& wraps) const;

  /// How firmly the touching path is held across: 0 where it is about to slip off (least_hold()); 1 without touches.
  double hold(const std::vector<Pose>& poses, const Wraps& wraps) const;

  /// Lets obstacle i touch or leave.
  void switch_touch(const std::vector<Pose>& poses, Wraps& wraps, std::size_t i) const;

  /// A point inside an obstacle beside it: a path cannot begin there.
  struct Inside {
    std::size_t obstacle = 0, point = 0;
    double depth = 0;  ///< m
  };
  std::vector<Inside> points_inside(const std::vector<Pose>& poses) const;

  /// Calls f(point, point, line) for every straight line, from end to end; points on obstacles are touching points.
  template <typename F>
  void for_each_line(const Wraps& wraps, const F& f) const {
    Point last = points_[0];
    std::size_t i = 0;
    for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
      for (; i < obstacles_.size() && at(obstacles_[i].after) == k; ++i) {
        const WrapTouch& touch = wraps[first_ + i];
        if (!touch.touching) continue;
        const int index = -1 - static_cast<int>(i);
        const Point touched{obstacles_[i].body, touch.arc.begin.p, obstacles_[i].moving, index};
        f(last, touched, TautLine{last.p, touched.p});
        last = {obstacles_[i].body, touch.arc.end.p, obstacles_[i].moving, index};
      }
      f(last, points_[k + 1], TautLine{last.p, points_[k + 1].p});
      last = points_[k + 1];
    }
  }

  /// Calls f(body, point of it in m) along the whole path, with points at most `spacing` (m) apart on obstacles.
  template <typename F>
  void for_each_place(const Wraps& wraps, double spacing, const F& f) const {
    std::size_t i = 0;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      f(points_[k].body, points_[k].p);
      for (; i < obstacles_.size() && at(obstacles_[i].after) == k; ++i)
        if (const WrapTouch& touch = wraps[first_ + i]; touch.touching)
          for_points(*obstacles_[i].surface, touch.arc, spacing, [&](const Vec3& p) { f(obstacles_[i].body, p); });
    }
  }

  /// m: the part of the length on obstacle i; 0 where it does not touch.
  double arc_length(const Wraps& wraps, std::size_t i) const {
    return wraps[first_ + i].touching ? wraps[first_ + i].arc.length : 0;
  }

  /// m; `poses` of every body in the world, `wraps` at these poses, here and below.
  double length(const std::vector<Pose>& poses, const Wraps& wraps = {}) const;

  /// Rate of the length for the rates `twist` (6 for each moving body): m per unit of their parameter.
  double length_rate(const std::vector<Pose>& poses, const VecX& twist, const Wraps& wraps = {}) const;

  /// g, 6 entries for each of `moving_count` bodies.
  VecX length_gradient(const std::vector<Pose>& poses, int moving_count, const Wraps& wraps = {}) const;

  /// Adds -tension g.
  void add_tension(const std::vector<Pose>& poses, double tension, VecX& wrench, const Wraps& wraps = {}) const;

  /// The same with derivatives: sets `gradient` to g, adds to `wrench` and, unless null, to `stiffness`. Allocates
  /// nothing.
  void linearize(const std::vector<Pose>& poses, const LawValue& tension, VecX& gradient, VecX& wrench, MatX* stiffness,
                 const Wraps& wraps = {}) const;

  /// A change of the path at fixed poses: rates of its points and arcs (world axes), per unit of a parameter.
  struct Change {
    std::vector<Vec3> points;     ///< m
    std::vector<ArcChange> arcs;  ///< of every obstacle
  };
  /// What the touching points add to the rate of the pull P of unit tension, 6 for each moving body, times `tension`:
  /// (dP/dz) dz. path_change.h has the rest.
  void add_touch_rate(const std::vector<Pose>& poses, const Wraps& wraps, const Change& change, double tension,
                      VecX& wrench) const;

 private:
  struct Span;
  struct Variation;
  Span span_at(const std::vector<Pose>& poses, const Wraps& wraps, std::size_t k) const;
  template <typename F>
  void for_each_span(const F& f) const;

  std::vector<Point> points_;
  std::vector<Obstacle> obstacles_;
  std::size_t first_ = 0;
};

}  // namespace genu
