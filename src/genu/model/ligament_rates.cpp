#include "genu/model/ligament_rates.h"

#include <algorithm>
#include <limits>

#include "genu/model/path_change.h"

namespace genu {
namespace {

using Rest = LigamentDef::Rest;
using Kind = Parameter::Kind;

/// The direct effect of a parameter, per SI unit: on a number of the law, on the slack length, on a point.
struct Direct {
  int number = -1;  ///< index in the law's table
  double rest = 0;
};

Direct direct_change(const Parameter& parameter) {
  Direct d;
  if (parameter.kind == Kind::law_number) d.number = parameter.number;
  if (parameter.kind == Kind::slack_length || parameter.kind == Kind::reference_strain ||
      parameter.kind == Kind::reference_force)
    d.rest = 1;
  return d;
}

/// The change of the path by a parameter; empty where it moves neither points nor surfaces.
std::optional<LigamentPath::Change> path_change(const LigamentAt& at, const std::vector<Pose>& poses,
                                                const Wraps& wraps, const Parameter& parameter,
                                                const std::vector<SurfaceDef>& surfaces) {
  const LigamentPath& path = at.made.path;
  const int axis = parameter.component % 3;
  switch (parameter.kind) {
    case Kind::from_point:
      return change_by_point(path, poses, 0, axis);
    case Kind::via_point:
      return change_by_point(path, poses, 1 + static_cast<std::size_t>(parameter.component / 3), axis);
    case Kind::to_point:
      return change_by_point(path, poses, path.points().size() - 1, axis);
    default:
      if (!parameter.of_surface()) return std::nullopt;
      return change_by_surface(at.def.wraps, path, poses, wraps, parameter, surfaces);
  }
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

/// Whether it touches a surface, at the pose or where the slack length comes from.
bool touches_ever(const LigamentAt& at, int surface) {
  return touches(at.def.wraps, at.made.path, at.wraps, surface) ||
         (at.def.rest != Rest::slack_length && touches(at.def.wraps, at.made.path, at.reference_wraps, surface));
}

double slack_rate(const LigamentAt& at, const Direct& d, const Parameter& parameter,
                  const std::vector<SurfaceDef>& surfaces) {
  if (at.def.rest == Rest::slack_length) return d.rest;
  const LigamentPath& path = at.made.path;
  const double length = path.length(at.reference_poses, at.reference_wraps);
  const auto change = path_change(at, at.reference_poses, at.reference_wraps, parameter, surfaces);
  const double rate = change ? length_rate(path, at.reference_poses, at.reference_wraps, *change) : 0;
  if (at.def.rest == Rest::reference_force) return slack_from_force(at, d, length, rate);
  const double slack = at.made.law.slack_length();
  return slack / length * rate - slack / (1 + at.def.rest_value) * d.rest;
}

/// A spring without length pulls by t = k d, whose size has no derivative.
LigamentRate spring_rate(const LigamentAt& at, double stiffness, const std::optional<LigamentPath::Change>& change) {
  LigamentRate out;
  out.length = out.strain = out.force = std::numeric_limits<double>::quiet_NaN();
  if (!change) return out;
  out.wrench.setZero(6 * at.moving_count);
  const auto& points = at.made.path.points();
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Vec3 pull = stiffness * (change->points[k + 1] - change->points[k]);
    for (const std::size_t end : {k, k + 1}) {
      if (points[end].moving < 0) continue;
      const double sign = end == k ? 1 : -1;
      const Vec3 arm = at.poses[static_cast<std::size_t>(points[end].body)].R * points[end].p;
      out.wrench.segment<3>(6 * points[end].moving) += sign * pull;
      out.wrench.segment<3>(6 * points[end].moving + 3) += sign * arm.cross(pull);
    }
  }
  return out;
}

}  // namespace

bool concerns(const LigamentDef& def, int ligament, const Parameter& parameter) {
  if (parameter.of_ligament()) return parameter.object == ligament;
  return parameter.of_surface() && std::any_of(def.wraps.begin(), def.wraps.end(),
                                               [&](const WrapDef& w) { return w.surface == parameter.object; });
}

LigamentRate ligament_rate(const LigamentAt& at, const Parameter& parameter, const std::vector<SurfaceDef>& surfaces) {
  if (parameter.of_surface() && !touches_ever(at, parameter.object)) return {};  // the surface does nothing to it
  const Direct direct = direct_change(parameter);
  const LigamentLaw& law = at.made.law;
  const LigamentPath& path = at.made.path;
  const auto change = path_change(at, at.poses, at.wraps, parameter, surfaces);
  const double length = path.length(at.poses, at.wraps);
  const double slack = law.slack_length(), slack_change = slack_rate(at, direct, parameter, surfaces);
  if (slack == 0 && length == 0) return spring_rate(at, law.evaluate(length).stiffness, change);
  LigamentRate out;
  if (change) out.length = length_rate(path, at.poses, at.wraps, *change);
  out.strain = (out.length - length / slack * slack_change) / slack;
  if (length <= law.slack_until()) return out;
  const LawValue value = law.evaluate(length);
  const LawRates rates = law.rates(length);
  const double held = by_number(rates, direct) + rates.force_by_slack_length * slack_change;  // at constant length
  out.force = value.stiffness * out.length + held;
  out.wrench.setZero(6 * at.moving_count);
  path.add_tension(at.poses, out.force, out.wrench, at.wraps);
  if (change) add_pull_rate(path, at.poses, at.wraps, *change, value.force, out.wrench);
  return out;
}

}  // namespace genu
