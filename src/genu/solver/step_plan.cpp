#include "genu/solver/step_plan.h"

#include <algorithm>
#include <cmath>

namespace genu {

Target StepPlan::target(double t) const {
  Target out;
  // This form is exact at both ends.
  const auto between = [t](double from, double to) { return (1 - t) * from + t * to; };
  for (const Prescribed& p : prescribed) out.prescribed.push_back({p.coordinate, between(p.from, p.to)});
  for (const Factor& f : factors) out.load_factors.push_back(between(f.from, f.to));
  out.time = between(start_time, end_time);
  return out;
}

Target StepPlan::rate() const {
  Target out;
  for (const Prescribed& p : prescribed) out.prescribed.push_back({p.coordinate, p.to - p.from});
  for (const Factor& f : factors) out.load_factors.push_back(f.to - f.from);
  out.time = end_time - start_time;
  return out;
}

double StepPlan::angle_range() const {
  double range = 0;
  for (const Prescribed& p : prescribed)
    if (p.coordinate.is_rotation()) range = std::max(range, std::abs(p.to - p.from));
  return range;
}

}  // namespace genu
