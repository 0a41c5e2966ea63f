// The path of a ligament: straight lines from point to point over the bodies, under one tension.
//
// L is the sum of the lines' lengths, g = dL/dX its gradient with respect to the twists of the moving bodies. A tension
// T exerts the wrench -T g; with T = T(L) its stiffness is -T' g g^T - T dg/dX. Laws, dampers, events, sensitivities
// and drawings use only the interface below, so another kind of path (for example wrapping over a surface) is added
// here.
#pragma once

#include <utility>
#include <vector>

#include "genu/core/pose.h"
#include "genu/core/types.h"
#include "genu/model/ligament.h"

namespace genu {

class LigamentPath {
 public:
  struct Point {
    int body = 0;
    Vec3 p = Vec3::Zero();  ///< m, in the body
    int moving = -1;        ///< index of the body among the moving ones; -1: fixed. Set by move_with()
  };

  LigamentPath() = default;
  /// Points in order from end to end; at least two.
  explicit LigamentPath(std::vector<Point> points) : points_(std::move(points)) {}

  const std::vector<Point>& points() const { return points_; }
  const Point& from() const { return points_.front(); }
  const Point& to() const { return points_.back(); }
  /// Whether there is only one line.
  bool is_straight() const { return points_.size() == 2; }

  /// Moves point k on its body (m).
  void set_point(std::size_t k, const Vec3& p) { points_[k].p = p; }

  /// `moving[i]`: the index of body i among the moving ones, -1 where it is fixed.
  void move_with(const std::vector<int>& moving);

  /// Calls f(point, point, line) for every straight line, from end to end.
  template <typename F>
  void for_each_line(const F& f) const {
    for (std::size_t k = 0; k + 1 < points_.size(); ++k)
      f(points_[k], points_[k + 1], TautLine{points_[k].p, points_[k + 1].p});
  }

  /// m; `poses` of every body in the world, here and below.
  double length(const std::vector<Pose>& poses) const;

  /// Rate of the length for the rates `twist` (6 for each moving body): m per unit of their parameter.
  double length_rate(const std::vector<Pose>& poses, const VecX& twist) const;

  /// g, 6 entries for each of `moving_count` bodies.
  VecX length_gradient(const std::vector<Pose>& poses, int moving_count) const;

  /// Adds -tension g.
  void add_tension(const std::vector<Pose>& poses, double tension, VecX& wrench) const;

  /// The same with derivatives: sets `gradient` to g, adds to `wrench` and, unless null, to `stiffness`. Allocates
  /// nothing.
  void linearize(const std::vector<Pose>& poses, const LawValue& tension, VecX& gradient, VecX& wrench,
                 MatX* stiffness) const;

 private:
  std::vector<Point> points_;
};

}  // namespace genu
