#include "genu/path/change_drivers.h"

namespace genu {

void change_drivers(const JointModel& model, const StepPlan* before, const StepPlan& step, State& state,
                    std::vector<double>& factors) {
  const std::size_t count = before != nullptr ? before->prescribed.size() : 0;
  const auto drivers_before = [&](std::size_t m) {
    return m < count ? before->prescribed[m].drivers : std::vector<int>();
  };
  for (std::size_t m = 0; m < count; ++m)
    for (const int driver : drivers_before(m)) factors[at(driver)] = state.multipliers[m];
  fit_multipliers(model, step.target(0), state);
  for (std::size_t m = 0; m < step.prescribed.size(); ++m) {
    const std::vector<int>& drivers = step.prescribed[m].drivers;
    if (drivers_before(m) != drivers) state.multipliers[m] = drivers.empty() ? 0 : 1;
  }
}

}  // namespace genu
