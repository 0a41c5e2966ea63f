#include "genu/study/laxity_result.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/study/tolerances.h"

namespace genu {

const LaxityRow* LaxityCurve::at(double load) const {
  const auto same = [&](const LaxityRow& row) { return std::abs(row.load - load) <= kSameLoad * test.load; };
  const auto found = std::find_if(rows.begin(), rows.end(), same);
  return found == rows.end() ? nullptr : &*found;
}

double LaxityCurve::loop() const {
  double most = std::numeric_limits<double>::quiet_NaN();
  for (const LaxityRow& row : rows) {
    const LaxityRow* forth = at(row.load);
    if (forth == &row) continue;
    const double apart = std::abs(test.displacement(row.motion) - test.displacement(forth->motion));
    most = std::isnan(most) ? apart : std::max(most, apart);
  }
  return most;
}

const LaxityRow* EnvelopePath::at(double flexion) const {
  const auto same = [&](const Row& row) { return std::abs(row.flexion - flexion) <= kSameFlexion; };
  const auto found = std::find_if(rows.begin(), rows.end(), same);
  return found == rows.end() ? nullptr : &found->pose;
}

}  // namespace genu
