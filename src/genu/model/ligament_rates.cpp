#include "genu/model/ligament_rates.h"

#include <algorithm>
#include <limits>

namespace genu {
namespace {

using Rest = LigamentDef::Rest;
using Kind = Parameter::Kind;

/// The direct effect of a parameter, per SI unit: on a number of the law, on the slack length, on a point.
struct Direct {
  int number = -1;  ///< index in the law's table
  double rest = 0;
  int point = -1;    ///< index of the points from end to end
  int axis = 0;      ///< axis in its body
  int surface = -1;  ///< index of the surface that moves along it
};

Direct direct_change(const LigamentDef& def, const Parameter& parameter) {
  Direct d;
  d.axis = parameter.component % 3;
  switch (parameter.kind) {
    case Kind::law_number:
      d.number = parameter.number;
      break;
    case Kind::slack_length:
    case Kind::reference_strain:
    case Kind::reference_force:
      d.rest = 1;
      break;
    case Kind::from_point:
      d.point = 0;
      break;
    case Kind::via_point:
      d.point = 1 + parameter.component / 3;
      break;
    case Kind::to_point:
      d.point = static_cast<int>(def.path_points().size()) - 1;
      break;
    case Kind::surface_number:
      d.surface = parameter.object;
      break;
    default:
      break;
  }
  return d;
}

/// One straight line of a ligament from a to b, in the world, and the velocities of its ends.
struct MovingLine {
  int body_a, body_b;
  Vec3 r_A, r_B;      ///< from the bodies' origins to the ends
  Vec3 end_A, end_B;  ///< velocities of the ends
  double length;
  Vec3 u;  ///< direction; 0 where the ends meet

  double length_rate() const { return u.dot(end_B - end_A); }
};

/// Whether a point of the path, or the surface that it lies on, moves along the axis.
bool moves(const LigamentDef& def, const Direct& change, int index) {
  return index >= 0 ? index == change.point
                    : change.surface >= 0 && def.wraps[at(-1 - index)].surface == change.surface;
}

std::vector<MovingLine> lines_of(const LigamentDef& def, const LigamentPath& path, const std::vector<Pose>& poses,
                                 const Wraps& wraps, const Direct& change) {
  std::vector<MovingLine> out;
  path.for_each_line(wraps, [&](const LigamentPath::Point& from, const LigamentPath::Point& to, const TautLine& taut) {
    const int a = from.body, b = to.body;
    const Pose &X_WA = poses[static_cast<std::size_t>(a)], &X_WB = poses[static_cast<std::size_t>(b)];
    const auto velocity = [&](const Pose& pose, int point) {
      return moves(def, change, point) ? Vec3(pose.R.col(change.axis)) : Vec3(Vec3::Zero());
    };
    MovingLine line{a, b, X_WA.R * taut.p_A, X_WB.R * taut.p_B, velocity(X_WA, from.index), velocity(X_WB, to.index),
                    0, {}};
    const Vec3 d = (X_WB.p - X_WA.p) + (line.r_B - line.r_A);
    line.length = d.norm();
    line.u = line.length > 0 ? Vec3(d / line.length) : Vec3::Zero();
    out.push_back(line);
  });
  return out;
}

/// Length (m) and its rate.
std::pair<double, double> length_of(const std::vector<MovingLine>& lines) {
  double length = 0, rate = 0;
  for (const MovingLine& line : lines) {
    length += line.length;
    rate += line.length_rate();
  }
  return {length, rate};
}

/// Wrench on [a; b] of the pull t on A, with the rates of t and of the ends.
Vec12 wrench_rate(const MovingLine& line, const Vec3& t, const Vec3& t_rate) {
  Vec12 out;
  out << t_rate, line.end_A.cross(t) + line.r_A.cross(t_rate), -t_rate, -line.end_B.cross(t) - line.r_B.cross(t_rate);
  return out;
}

double by_number(const LawRates& r, const Direct& d) { return d.number < 0 ? 0 : r.force_by_number[at(d.number)]; }

/// dL0 where the law has a force at the reference length.
double slack_from_force(const LigamentAt& at, const Direct& d, double length, double length_rate) {
  const LawRates r = at.made.law.rates(length);
  const double by_length = r.slack_length_by_length * length_rate;
  const double missing = d.rest - by_number(r, d);  // change of force that the slack length must compensate
  if (missing == 0) return by_length;
  if (r.force_by_slack_length == 0) return std::numeric_limits<double>::quiet_NaN();
  return by_length + missing / r.force_by_slack_length;
}

/// Whether a surface's parameter moves it as a whole.
bool is_origin(const SurfaceDef& def, const Parameter& parameter) {
  return parameter.kind == Kind::surface_number &&
         kind_of(def).numbers[static_cast<std::size_t>(parameter.number)].values_of(def) == def.placement.p.data();
}

/// Whether it touches a surface, at the pose or where the slack length comes from.
bool touches(const LigamentAt& at, int surface) {
  for (std::size_t i = 0; i < at.def.wraps.size(); ++i) {
    const std::size_t k = at.made.path.touch_index(i);
    if (at.def.wraps[i].surface != surface) continue;
    if (at.wraps[k].touching) return true;
    if (at.def.rest != Rest::slack_length && at.reference_wraps[k].touching) return true;
  }
  return false;
}

double slack_rate(const LigamentAt& at, const Direct& d) {
  if (at.def.rest == Rest::slack_length) return d.rest;
  auto [length, length_rate] = length_of(lines_of(at.def, at.made.path, at.reference_poses, at.reference_wraps, d));
  length = at.made.path.length(at.reference_poses, at.reference_wraps);
  if (at.def.rest == Rest::reference_force) return slack_from_force(at, d, length, length_rate);
  const double slack = at.made.law.slack_length();
  return slack / length * length_rate - slack / (1 + at.def.rest_value) * d.rest;
}

}  // namespace

bool concerns(const LigamentDef& def, int ligament, const Parameter& parameter) {
  if (parameter.of_ligament()) return parameter.object == ligament;
  return parameter.of_surface() && std::any_of(def.wraps.begin(), def.wraps.end(),
                                               [&](const WrapDef& w) { return w.surface == parameter.object; });
}

LigamentRate ligament_rate(const LigamentAt& at, const Parameter& parameter, const std::vector<SurfaceDef>& surfaces) {
  if (parameter.of_surface() && !touches(at, parameter.object)) return {};  // the surface does nothing to it
  if (parameter.of_surface() && !is_origin(surfaces[static_cast<std::size_t>(parameter.object)], parameter)) {
    LigamentRate none;
    none.length = none.strain = none.force = std::numeric_limits<double>::quiet_NaN();
    none.touches.setConstant(6 * at.moving_count, none.force);
    return none;
  }
  const Direct change = direct_change(at.def, parameter);
  const LigamentLaw& law = at.made.law;
  const std::vector<MovingLine> lines = lines_of(at.def, at.made.path, at.poses, at.wraps, change);
  const double length_rate = length_of(lines).second, length = at.made.path.length(at.poses, at.wraps);
  const double slack = law.slack_length(), slack_change = slack_rate(at, change);
  LigamentRate out;
  if (slack == 0 && length == 0) {  // a spring without length: t = k d, whose size has no derivative
    const double k = law.evaluate(length).stiffness;
    for (const MovingLine& line : lines)
      out.lines.push_back({line.body_a, line.body_b, wrench_rate(line, Vec3::Zero(), k * (line.end_B - line.end_A))});
    out.length = out.strain = out.force = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  out.length = length_rate;
  out.strain = (out.length - length / slack * slack_change) / slack;
  if (length <= law.slack_until()) return out;
  const LawValue value = law.evaluate(length);
  const LawRates rates = law.rates(length);
  const double held = by_number(rates, change) + rates.force_by_slack_length * slack_change;  // at constant length
  out.force = value.stiffness * out.length + held;
  for (const MovingLine& line : lines) {
    const Vec3 across = line.end_B - line.end_A - line.u * line.length_rate();
    const Vec3 turned = line.length > 0 ? Vec3(value.force / line.length * across) : Vec3::Zero();
    out.lines.push_back(
        {line.body_a, line.body_b, wrench_rate(line, value.force * line.u, out.force * line.u + turned)});
  }
  if (!at.made.path.obstacles().empty() && (change.point >= 0 || change.surface >= 0)) {
    LigamentPath::Change moved;
    moved.points.assign(at.made.path.points().size(), Vec3::Zero());
    moved.obstacles.assign(at.made.path.obstacles().size(), Vec3::Zero());
    const auto axis_of = [&](int body) { return Vec3(at.poses[static_cast<std::size_t>(body)].R.col(change.axis)); };
    for (std::size_t k = 0; k < moved.points.size(); ++k)
      if (moves(at.def, change, static_cast<int>(k))) moved.points[k] = axis_of(at.made.path.points()[k].body);
    for (std::size_t i = 0; i < moved.obstacles.size(); ++i)
      if (moves(at.def, change, -1 - static_cast<int>(i)))
        moved.obstacles[i] = axis_of(at.made.path.obstacles()[i].body);
    out.touches.setZero(6 * at.moving_count);
    at.made.path.add_touch_rate(at.poses, at.wraps, moved, value.force, out.touches);
  }
  return out;
}

}  // namespace genu
