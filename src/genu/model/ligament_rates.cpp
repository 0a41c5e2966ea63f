#include "genu/model/ligament_rates.h"

#include <limits>

namespace genu {
namespace {

using Law = LigamentDef::Law;
using Rest = LigamentDef::Rest;
using Kind = Parameter::Kind;

/// What a parameter changes first, per SI unit: numbers of the law, what sets the slack length, an end.
struct Direct {
  double stiffness = 0, toe_stiffness = 0, transition_strain = 0, rest = 0;
  Vec3 end_A = Vec3::Zero(), end_B = Vec3::Zero();  ///< in their bodies
};

Direct direct_change(const Parameter& parameter) {
  Direct d;
  switch (parameter.kind) {
    case Kind::stiffness:
      d.stiffness = 1;
      break;
    case Kind::toe_stiffness:
      d.toe_stiffness = 1;
      break;
    case Kind::transition_strain:
      d.transition_strain = 1;
      break;
    case Kind::slack_length:
    case Kind::reference_strain:
    case Kind::reference_force:
      d.rest = 1;
      break;
    case Kind::from_point:
      d.end_A[parameter.component] = 1;
      break;
    case Kind::to_point:
      d.end_B[parameter.component] = 1;
      break;
    default:
      break;
  }
  return d;
}

double by_numbers(const LawRates& r, const Direct& d) {
  return r.stiffness * d.stiffness + r.toe_stiffness * d.toe_stiffness + r.transition_strain * d.transition_strain;
}

/// L / L0 times dL0/dL at a force held: strain laws keep the strain, the others the stretch.
double slack_by_length(const LigamentDef& def, const LigamentLaw& law, double length) {
  if (def.law == Law::spring) return 1;
  if (def.law != Law::abdel_rahman) return law.slack_length() / length;
  const bool toe = length - law.slack_length() <= def.transition_strain * law.slack_length();
  return toe ? 1 : 1 / (1 + def.transition_strain / 2);
}

/// dL0 where the law has a force at the reference length.
double slack_from_force(const LigamentAt& at, const Direct& d, double length, double length_rate) {
  const double by_length = slack_by_length(at.def, at.ligament.law, length) * length_rate;
  const LawRates r = law_rates(at.def, at.ligament.law, length);
  const double missing = d.rest - by_numbers(r, d);  // force to be made up for by the slack length
  if (missing == 0) return by_length;
  if (r.slack_length == 0) return std::numeric_limits<double>::quiet_NaN();
  return by_length + missing / r.slack_length;
}

double slack_rate(const LigamentAt& at, const Direct& d) {
  if (at.def.rest == Rest::slack_length) return d.rest;
  const Vec3 line = at.reference_B * at.ligament.p_B - at.reference_A * at.ligament.p_A;
  const double length = line.norm();
  const double length_rate = line.dot(at.reference_B.R * d.end_B - at.reference_A.R * d.end_A) / length;
  if (at.def.rest == Rest::reference_force) return slack_from_force(at, d, length, length_rate);
  const double slack = at.ligament.law.slack_length();
  return slack / length * length_rate - slack / (1 + at.def.rest_value) * d.rest;
}

}  // namespace

LawRates law_rates(const LigamentDef& def, const LigamentLaw& law, double length) {
  LawRates out;
  if (length <= law.slack_until()) return out;
  const LawValue value = law.evaluate(length);
  const double slack = law.slack_length();
  const bool toe = length - slack <= def.transition_strain * slack;
  if (def.law != Law::table) out.stiffness = value.force / def.stiffness;
  out.slack_length = -value.stiffness * length / slack;  // of a law of the strain alone
  switch (def.law) {
    case Law::spring:
      out.slack_length = -value.stiffness;
      break;
    case Law::blankevoort:
      out.transition_strain = toe ? -value.force / def.transition_strain : -def.stiffness / 2;
      break;
    case Law::abdel_rahman:
      out.slack_length = -value.stiffness * (toe ? 1 : 1 + def.transition_strain / 2);
      if (toe) {
        out.stiffness = 0;
        out.toe_stiffness = value.force / def.toe_stiffness;
      } else {
        out.transition_strain = -def.stiffness * slack / 2;
      }
      break;
    case Law::quadratic:
    case Law::linear:
    case Law::table:
      break;
  }
  return out;
}

LigamentRate ligament_rate(const LigamentAt& at, const Parameter& parameter) {
  const Direct change = direct_change(parameter);
  const LigamentLaw& law = at.ligament.law;
  const Vec3 r_A = at.X_WA.R * at.ligament.p_A, r_B = at.X_WB.R * at.ligament.p_B;
  const Vec3 end_A = at.X_WA.R * change.end_A, end_B = at.X_WB.R * change.end_B;
  const Vec3 line = (at.X_WB.p - at.X_WA.p) + (r_B - r_A), line_rate = end_B - end_A;
  const double length = line.norm(), slack = law.slack_length();
  const double slack_change = slack_rate(at, change);
  LigamentRate out;
  if (slack == 0 && length == 0) {  // a spring without length: t = k d, whose size has no derivative
    out.length = out.strain = out.force = std::numeric_limits<double>::quiet_NaN();
    out.on_a.head<3>() = law.evaluate(length).stiffness * line_rate;
    out.on_a.tail<3>() = r_A.cross(out.on_a.head<3>());
    out.on_b << -out.on_a.head<3>(), -r_B.cross(out.on_a.head<3>());
    return out;
  }
  const Vec3 u = line / length;
  out.length = u.dot(line_rate);
  out.strain = (out.length - length / slack * slack_change) / slack;
  if (length <= law.slack_until()) return out;
  const LawValue value = law.evaluate(length);
  const LawRates rates = law_rates(at.def, law, length);
  const double held = by_numbers(rates, change) + rates.slack_length * slack_change;  // at the length held
  out.force = value.stiffness * out.length + held;
  const Vec3 pull = value.force * u;
  const Vec3 pull_rate = out.force * u + value.force / length * (line_rate - u * out.length);
  out.on_a << pull_rate, end_A.cross(pull) + r_A.cross(pull_rate);
  out.on_b << -pull_rate, -end_B.cross(pull) - r_B.cross(pull_rate);
  return out;
}

}  // namespace genu
