#include "genu/model/ligament_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/law/laws.h"
#include "genu/model/tolerances.h"
#include "genu/scene/law_values.h"

namespace genu {

namespace {

using Rest = LigamentDef::Rest;

/// A law with jumps skips some forces: a length counts only if the law returns the force there, to rounding of the
/// length.
bool has_force(const LigamentLaw& law, double length, double force) {
  const LawValue v = law.evaluate(length);
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * length * v.stiffness;
  return std::abs(v.force - force) <= kForceInverseTolerance * std::abs(force) + rounding;
}

/// The error in the numbers of a law; empty if there is none.
std::string fault(const LawKind& kind, const LawValues& values, double rest_value) {
  for (std::size_t k = 0; k < kind.numbers.size(); ++k)
    if (const std::string wrong = kind.numbers[k].fault(values.numbers[k]); !wrong.empty()) return wrong;
  if (!std::isfinite(rest_value)) return "slack length, reference strain or force must be finite";
  return kind.points ? kind.fault_of_points(values) : std::string();
}

}  // namespace

LigamentLaw::LigamentLaw(std::shared_ptr<const ForceLaw> law)
    : law_(std::move(law)),
      slack_length_(law_->slack_length().value_or(std::numeric_limits<double>::quiet_NaN())),
      slack_until_(law_->slack_until()),
      breaks_(law_->breaks()) {
  find_sharp_breaks();
}

LawValue LigamentLaw::evaluate(double length) const {
  if (length <= slack_until_) return {};
  return law_->evaluate(length);
}

LawRates LigamentLaw::rates(double length) const {
  LawRates out = law_->rates(length);
  if (length > slack_until_) return out;
  std::fill(out.force_by_number.begin(), out.force_by_number.end(), 0);
  out.force_by_slack_length = 0;
  return out;
}

double LigamentLaw::strain(double length) const {
  if (!(slack_length_ > 0)) return std::numeric_limits<double>::quiet_NaN();
  return (length - slack_length_) / slack_length_;
}

std::optional<LigamentLaw> make_law(const LigamentDef& def, double reference_length, std::string& why) {
  const LawKind* kind = find_law(def.law);
  if (kind == nullptr) {
    why = "there is no law \"" + def.law + "\"";
    return std::nullopt;
  }
  const LawValues values = law_values(*kind, def);
  why = fault(*kind, values, def.rest_value);
  if (!why.empty()) return std::nullopt;
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
  if (def.rest == Rest::reference_force) slack = kind->slack_length_for(values, def.rest_value, reference_length);

  const bool possible = slack && std::isfinite(*slack) && (kind->both_ways ? *slack >= 0 : *slack > 0);
  if (def.rest == Rest::slack_length && !possible) {
    why = kind->both_ways ? "slack_length must be >= 0" : "slack_length must be > 0";
    return std::nullopt;
  }
  if (possible) {
    LigamentLaw law(kind->make(values, *slack));
    if (def.rest != Rest::reference_force || has_force(law, reference_length, def.rest_value)) return law;
  }
  why = fmt::format("no slack length gives the law {} N at the reference length of {} m", def.rest_value,
                    reference_length);
  return std::nullopt;
}

}  // namespace genu
