#include "genu/law/force_law.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "genu/law/tolerances.h"

namespace genu {
namespace {

bool differ(double a, double b) { return std::abs(a - b) > kLawJumpTolerance * std::max(std::abs(a), std::abs(b)); }

}  // namespace

bool LawBreak::jumps() const { return differ(below.force, above.force); }

bool LawBreak::sharp() const { return jumps() || differ(below.stiffness, above.stiffness); }

double ForceLaw::slack_until() const {
  const std::vector<LawBreak> all = breaks();
  return !all.empty() && all.front().below.slack ? all.front().length : kNeverSlack;
}

LawRates ForceLaw::rates(double) const { return {}; }

LawRates rates_of_strain_law(const LawValue& value, double length, double slack_length,
                             std::vector<double> force_by_number) {
  return {std::move(force_by_number), -value.stiffness * length / slack_length, slack_length / length};
}

}  // namespace genu
