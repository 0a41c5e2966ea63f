#include "genu/judge/tension.h"

#include <algorithm>
#include <cmath>

#include "genu/judge/curve.h"

namespace genu::judge {
namespace {

using Law = LigamentDef::Law;

}  // namespace

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
  const double stretch = length - slack, e = stretch / slack;
  if (d.law == Law::spring) return d.stiffness * stretch;
  if (d.law == Law::table) return curve_at(d.table, e);
  if (e <= 0) return 0;
  switch (d.law) {
    case Law::quadratic:
      return d.stiffness * e * e;
    case Law::linear:
      return d.stiffness * e;
    case Law::blankevoort:
      return e <= d.transition_strain ? d.stiffness * e * e / (2 * d.transition_strain)
                                      : d.stiffness * (e - d.transition_strain / 2);
    case Law::abdel_rahman:
      return e <= d.transition_strain ? d.toe_stiffness * stretch * stretch
                                      : d.stiffness * (length - (1 + d.transition_strain / 2) * slack);
    case Law::spring:
    case Law::table:
      break;
  }
  return 0;
}

/// The slack length with which the law rises past a force for the first time at a length: looked for along the strain.
double TensionLaw::slack_for(double asked, double length) const {
  if (def_->law == Law::spring) {
    const double slack = length - asked / def_->stiffness;
    return std::abs(slack) < 1e-15 * length ? 0 : slack;
  }
  const auto above = [&](double e) { return force(length, length / (1 + e)) > asked; };
  double low = def_->law == Law::table ? std::max(-0.999, def_->table.front().first - 0.5) : 0;
  const double step = 1e-4;
  double high = low;
  while (!above(high)) {
    low = high;
    high += step;
    if (high > 20) return length / (1 + (def_->law == Law::table ? def_->table.back().first : 0));
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
  if (def_->law != Law::abdel_rahman) return t;
  const double jump = (1 + def_->transition_strain) * slack_;
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
  for (const LigamentDef::End& end : ligament.points()) path.push_back(place(end));
  return path;
}

double length_of(const std::vector<Vec3>& path) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) length += (path[i + 1] - path[i]).norm();
  return length;
}

std::vector<int> bodies_on(const LigamentDef& ligament) {
  std::vector<int> bodies;
  for (const LigamentDef::End& end : ligament.points()) bodies.push_back(end.body);
  return bodies;
}

}  // namespace genu::judge
