#include "genu/judge/tension.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/judge/curve.h"

namespace genu::judge {

TensionLaw::TensionLaw(const LigamentDef& def, double reference_length) : def_(&def) {
  switch (def.rest) {
    case LigamentDef::Rest::slack_length:
      slack_ = def.rest_value;
      break;
    case LigamentDef::Rest::reference_strain:
      slack_ = reference_length / (1 + def.rest_value);
      break;
    case LigamentDef::Rest::reference_force:
      slack_ = slack_for(def.rest_value, reference_length);
      break;
  }
}

double TensionLaw::force(double length, double slack) const {
  const LigamentDef& d = *def_;
  const double stretch = length - slack, e = stretch / slack, k = d.number("stiffness"),
               e_t = d.number("transition_strain");
  if (d.law == "spring") return k * stretch;
  if (d.law == "table") return curve_at(d.points, e);
  if (e <= 0) return 0;
  if (d.law == "quadratic") return k * e * e;
  if (d.law == "linear") return k * e;
  if (d.law == "blankevoort") return e <= e_t ? k * e * e / (2 * e_t) : k * (e - e_t / 2);
  if (d.law == "abdel-rahman")
    return e <= e_t ? d.number("toe_stiffness") * stretch * stretch : k * (length - (1 + e_t / 2) * slack);
  if (d.law == "exponential") return d.number("force_scale") * std::expm1(d.number("exponent") * e);
  return std::numeric_limits<double>::quiet_NaN();  // an unknown law
}

/// The slack length with which the law first exceeds a force at a length, searched along the strain.
double TensionLaw::slack_for(double asked, double length) const {
  if (def_->law == "spring") {
    const double slack = length - asked / def_->number("stiffness");
    return std::abs(slack) < 1e-15 * length ? 0 : slack;
  }
  const auto above = [&](double e) { return force(length, length / (1 + e)) > asked; };
  double low = def_->law == "table" ? std::max(-0.999, def_->points.front().first - 0.5) : 0;
  const double step = 1e-4;
  double high = low;
  while (!above(high)) {
    low = high;
    high += step;
    if (high > 20) return length / (1 + (def_->law == "table" ? def_->points.back().first : 0));
  }
  for (int i = 0; i < 100; ++i) {
    const double middle = low + (high - low) / 2;
    (above(middle) ? high : low) = middle;
  }
  return length / (1 + high);
}

double TensionLaw::stiffness(double length) const {
  const double h = 1e-6 * length + 1e-12;
  return std::abs(force(length + h, slack_) - force(length - h, slack_)) / h;
}

Tension TensionLaw::at(double length, double rounding) const {
  const double f = force(length, slack_);
  Tension t{f, f};
  if (def_->law != "abdel-rahman") return t;
  const double jump = (1 + def_->number("transition_strain")) * slack_;
  if (std::abs(length - jump) > rounding) return t;
  for (const double l : {jump * (1 - 1e-14), jump * (1 + 1e-14)}) {
    t.low = std::min(t.low, force(l, slack_));
    t.high = std::max(t.high, force(l, slack_));
  }
  return t;
}

std::vector<Vec3> path_of(const LigamentDef& ligament, const std::vector<Pose>& poses) {
  const auto place = [&](const LigamentDef::End& end) -> Vec3 { return poses[at(end.body)] * end.point; };
  std::vector<Vec3> path;
  for (const LigamentDef::End& end : ligament.path_points()) path.push_back(place(end));
  return path;
}

double length_of(const std::vector<Vec3>& path) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) length += (path[i + 1] - path[i]).norm();
  return length;
}

std::vector<int> bodies_on(const LigamentDef& ligament) {
  std::vector<int> bodies;
  for (const LigamentDef::End& end : ligament.path_points()) bodies.push_back(end.body);
  return bodies;
}

}  // namespace genu::judge
