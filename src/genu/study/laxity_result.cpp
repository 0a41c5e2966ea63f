#include "genu/study/laxity_result.h"

#include <algorithm>
#include <cmath>

#include "genu/study/tolerances.h"

namespace genu {

const LaxityRow* LaxityCurve::at(double load) const {
  const auto same = [&](const LaxityRow& row) { return std::abs(row.load - load) <= kSameLoad * test.load; };
  const auto found = std::find_if(rows.begin(), rows.end(), same);
  return found == rows.end() ? nullptr : &*found;
}

double LaxityCurve::loop() const {
  double most = 0;
  for (const LaxityRow& row : rows)
    most = std::max(most, std::abs(test.displacement(row.motion) - test.displacement(at(row.load)->motion)));
  return most;
}

}  // namespace genu
