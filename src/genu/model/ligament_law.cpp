#include "genu/model/ligament_law.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace genu {

namespace {

using Law = LigamentDef::Law;
using Rest = LigamentDef::Rest;

constexpr double kNeverSlack = -1;

/// What is wrong with the law's parameters; empty if nothing is.
std::string parameter_fault(const LigamentDef& def) {
  const bool has_transition = def.law == Law::blankevoort || def.law == Law::abdel_rahman;
  if (def.law != Law::table && !(def.stiffness > 0 && std::isfinite(def.stiffness))) return "stiffness must be > 0";
  if (def.law == Law::abdel_rahman && !(def.toe_stiffness > 0 && std::isfinite(def.toe_stiffness)))
    return "toe_stiffness must be > 0";
  if (has_transition && !(def.transition_strain >= 0 && std::isfinite(def.transition_strain)))
    return "transition_strain must be >= 0";
  if (!std::isfinite(def.rest_value)) return "slack length, reference strain or force must be finite";
  return {};
}

/// A law that jumps skips some forces: only what the law gives back counts, to the rounding of the length.
bool has_force(const LigamentLaw& law, double length, double force) {
  const LawValue v = law.evaluate(length);
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * length * v.stiffness;
  constexpr double kRelativeTolerance = 1e-9;
  return std::abs(v.force - force) <= kRelativeTolerance * std::abs(force) + rounding;
}

}  // namespace

LigamentLaw::LigamentLaw(const LigamentDef& def)
    : kind_(def.law),
      stiffness_(def.stiffness),
      toe_stiffness_(def.toe_stiffness),
      transition_strain_(def.transition_strain) {}

LawValue LigamentLaw::evaluate(double length) const {
  if (length <= slack_until_) return {};
  if (custom_) return custom_->evaluate(length);
  // Exact up to twice the slack length (Sterbenz): the strain loses nothing near 0.
  const double stretch = length - slack_length_;
  const double k = stiffness_;
  switch (kind_) {
    case Law::spring:
      return {k * stretch, k, k * stretch * stretch / 2};
    case Law::quadratic: {
      const double e = stretch / slack_length_;
      return {k * e * e, 2 * k * e / slack_length_, k * e * e * stretch / 3};
    }
    case Law::linear:
      return {k * stretch / slack_length_, k / slack_length_, k * stretch / slack_length_ * stretch / 2};
    case Law::blankevoort:
      return toe_and_line(stretch / slack_length_);
    case Law::abdel_rahman:
      return abdel_rahman(length);
    case Law::table:
      return tabulated(stretch / slack_length_);
  }
  return {};
}

double LigamentLaw::strain(double length) const {
  if (!(slack_length_ > 0)) return std::numeric_limits<double>::quiet_NaN();
  return (length - slack_length_) / slack_length_;
}

LawValue LigamentLaw::toe_and_line(double e) const {
  const double k = stiffness_, e_t = transition_strain_;
  if (e <= e_t)
    return {k * e * e / (2 * e_t), k * e / (e_t * slack_length_), slack_length_ * k * e * e * e / (6 * e_t)};
  return {k * (e - e_t / 2), k / slack_length_, slack_length_ * k * (e_t * e_t / 6 + e * (e - e_t) / 2)};
}

LawValue LigamentLaw::abdel_rahman(double length) const {
  const double d = length - slack_length_, d_t = transition_strain_ * slack_length_;
  // The very comparison that parts the pieces: rounding of d must not put a length on the other side of the jump.
  if (length <= transition_length_)
    return {toe_stiffness_ * d * d, 2 * toe_stiffness_ * d, toe_stiffness_ * d * d * d / 3};
  return {stiffness_ * (d - d_t / 2), stiffness_,
          toe_stiffness_ * d_t * d_t * d_t / 3 + stiffness_ * d * (d - d_t) / 2};
}

LawValue LigamentLaw::tabulated(double e) const {
  const MonotoneTable::Value v = table_->evaluate(e);
  return {v.y, v.slope / slack_length_, slack_length_ * (v.integral - table_origin_)};
}

void LigamentLaw::set_slack_length(double slack_length) {
  slack_length_ = slack_length;
  slack_until_ = slack_length;
  if (kind_ == Law::spring) slack_until_ = kNeverSlack;
  if (kind_ == Law::table) {
    const std::optional<double> zero_until = table_->zero_until();
    slack_until_ = zero_until ? (1 + *zero_until) * slack_length : kNeverSlack;
    table_origin_ = table_->evaluate(zero_until.value_or(0)).integral;
  }
  transition_length_ = (1 + transition_strain_) * slack_length;
  set_breaks();
}

/// The strain at which a law of the strain alone has the force (N).
std::optional<double> LigamentLaw::strain_for(double force) const {
  if (kind_ == Law::table) return table_->first_rise_through(force);
  if (force < 0) return std::nullopt;
  const double ratio = force / stiffness_, e_t = transition_strain_;
  if (kind_ == Law::quadratic) return std::sqrt(ratio);
  if (kind_ == Law::blankevoort) return ratio <= e_t / 2 ? std::sqrt(2 * e_t * ratio) : ratio + e_t / 2;
  return ratio;
}

/// The slack length with which the law has the force (N) at the length (m).
std::optional<double> LigamentLaw::slack_length_for(double force, double length) const {
  if (kind_ == Law::spring) {
    const double slack = length - force / stiffness_;
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * length;
    return std::abs(slack) <= rounding ? 0 : slack;  // meant as 0: a remainder of rounding has no direction to push in
  }
  if (kind_ == Law::abdel_rahman) {
    if (force < 0) return std::nullopt;
    const double toe = length - std::sqrt(force / toe_stiffness_);
    if (length - toe <= transition_strain_ * toe) return toe;
    return (length - force / stiffness_) / (1 + transition_strain_ / 2);
  }
  const std::optional<double> e = strain_for(force);
  if (!e || *e <= -1) return std::nullopt;
  return length / (1 + *e);
}

std::optional<LigamentLaw> make_law(const LigamentDef& def, double reference_length, std::string& why) {
  why = parameter_fault(def);
  if (!why.empty()) return std::nullopt;
  LigamentLaw law(def);
  if (def.law == Law::table && !(law.table_ = MonotoneTable::make(def.table, why))) return std::nullopt;
  if (def.rest != Rest::slack_length && !(reference_length > 0)) {
    why = "the reference pose brings the two ends together: give slack_length";
    return std::nullopt;
  }
  if (def.rest == Rest::reference_strain && !(def.rest_value > -1)) {
    why = "reference_strain must be > -1";
    return std::nullopt;
  }
  std::optional<double> slack = def.rest_value;
  if (def.rest == Rest::reference_strain) slack = reference_length / (1 + def.rest_value);
  if (def.rest == Rest::reference_force) slack = law.slack_length_for(def.rest_value, reference_length);

  if (def.rest == Rest::slack_length && !(*slack > 0) && !(def.law == Law::spring && *slack == 0)) {
    why = def.law == Law::spring ? "slack_length must be >= 0" : "slack_length must be > 0";
    return std::nullopt;
  }
  const bool possible = slack && std::isfinite(*slack) && (*slack > 0 || (def.law == Law::spring && *slack == 0));
  if (possible) law.set_slack_length(*slack);
  const bool gives_force = possible && has_force(law, reference_length, def.rest_value);
  if (!possible || (def.rest == Rest::reference_force && !gives_force)) {
    why = fmt::format("no slack length gives the law {} N at the reference length of {} m", def.rest_value,
                      reference_length);
    return std::nullopt;
  }
  return law;
}

}  // namespace genu
