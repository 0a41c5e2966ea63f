#include "genu/model/path_change.h"

#include <limits>

#include "genu/model/surface_rates.h"

namespace genu {
namespace {

LigamentPath::Change no_change(const LigamentPath& path) {
  return {std::vector<Vec3>(path.points().size(), Vec3::Zero()), std::vector<ArcChange>(path.obstacles().size())};
}

/// In the world, of an arc in the frame of its body.
ArcChange turned(const Mat3& R, ArcChange change) {
  change.begin = R * change.begin;
  change.end = R * change.end;
  return change;
}

ArcChange without_value() {
  ArcChange none;
  none.length = none.turn = std::numeric_limits<double>::quiet_NaN();
  none.begin.setConstant(none.length);
  none.end.setConstant(none.length);
  return none;
}

using Point = LigamentPath::Point;

/// Calls f(point, point, way between them in the world, their rates) for every line.
template <typename F>
void for_each_moving_line(const LigamentPath& path, const std::vector<Pose>& poses, const Wraps& wraps,
                          const LigamentPath::Change& change, const F& f) {
  path.for_each_line(wraps, [&](const Point& a, const Point& b, const TautLine&) {
    const Vec3& rate_a = a.index >= 0 ? change.points[at(a.index)] : change.arcs[at(-1 - a.index)].end;
    const Vec3& rate_b = b.index >= 0 ? change.points[at(b.index)] : change.arcs[at(-1 - b.index)].begin;
    f(a, b, Vec3(poses[at(b.body)] * b.p - poses[at(a.body)] * a.p), rate_a, rate_b);
  });
}

}  // namespace

bool is_origin(const SurfaceDef& def, const Parameter& parameter) {
  return parameter.kind == Parameter::Kind::surface_number &&
         kind_of(def).numbers[at(parameter.number)].values_of(def) == def.placement.p.data();
}

bool touches(const std::vector<WrapDef>& defs, const LigamentPath& path, const Wraps& wraps, int surface) {
  for (std::size_t i = 0; i < defs.size(); ++i)
    if (defs[i].surface == surface && wraps[path.touch_index(i)].touching) return true;
  return false;
}

LigamentPath::Change change_by_surface(const std::vector<WrapDef>& defs, const LigamentPath& path,
                                       const std::vector<Pose>& poses, const Wraps& wraps, const Parameter& parameter,
                                       const std::vector<SurfaceDef>& surfaces) {
  LigamentPath::Change out = no_change(path);
  const SurfaceDef& def = surfaces[at(parameter.object)];
  for (std::size_t i = 0; i < defs.size(); ++i) {
    const WrapTouch& touch = wraps[path.touch_index(i)];
    if (defs[i].surface != parameter.object || !touch.touching) continue;
    const LigamentPath::Obstacle& obstacle = path.obstacles()[i];
    const Mat3& R = poses[at(obstacle.body)].R;
    ArcChange& arc = out.arcs[i];
    if (is_origin(def, parameter)) {
      arc.begin = arc.end = R.col(parameter.component);
      continue;
    }
    const auto speed = [&](const SurfacePoint& point) {
      const SurfaceChange change = surface_change(def, parameter, point);
      return NormalSpeed{change.w, change.gradient};
    };
    arc = arc_change(*obstacle.surface, touch.arc, speed, arc) ? turned(R, arc) : without_value();
  }
  return out;
}

LigamentPath::Change change_by_point(const LigamentPath& path, const std::vector<Pose>& poses, std::size_t index,
                                     int axis) {
  LigamentPath::Change out = no_change(path);
  out.points[index] = poses[at(path.points()[index].body)].R.col(axis);
  return out;
}

double length_rate(const LigamentPath& path, const std::vector<Pose>& poses, const Wraps& wraps,
                   const LigamentPath::Change& change) {
  double rate = 0;
  for_each_moving_line(path, poses, wraps, change,
                       [&](const Point&, const Point&, const Vec3& d, const Vec3& rate_a, const Vec3& rate_b) {
                         if (d.norm() > 0) rate += d.normalized().dot(rate_b - rate_a);
                       });
  for (std::size_t i = 0; i < change.arcs.size(); ++i)
    if (wraps[path.touch_index(i)].touching) rate += change.arcs[i].length;
  return rate;
}

void add_pull_rate(const LigamentPath& path, const std::vector<Pose>& poses, const Wraps& wraps,
                   const LigamentPath::Change& change, double tension, VecX& wrench) {
  for_each_moving_line(path, poses, wraps, change,
                       [&](const Point& a, const Point& b, const Vec3& d, const Vec3& rate_a, const Vec3& rate_b) {
                         const double length = d.norm();
                         if (a.moving == b.moving || !(length > 0)) return;
                         const Vec3 e = d / length, moved = rate_b - rate_a;
                         const Vec3 pull = tension * e, turn = tension / length * (moved - e.dot(moved) * e);
                         const auto add = [&](const Point& end, const Vec3& rate, double sign) {
                           if (end.moving < 0) return;
                           const Vec3 arm = poses[at(end.body)].R * end.p;
                           wrench.segment<3>(6 * end.moving) += sign * turn;
                           wrench.segment<3>(6 * end.moving + 3) += sign * (rate.cross(pull) + arm.cross(turn));
                         };
                         add(a, rate_a, 1);
                         add(b, rate_b, -1);
                       });
  path.add_touch_rate(poses, wraps, change, tension, wrench);
}

}  // namespace genu
