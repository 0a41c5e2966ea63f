#include "genu/equilibrium/held_drivers.h"

namespace genu {

HeldDrivers::HeldDrivers(const JointModel& model, const Target& target, State& state) : held_(target) {
  fit_multipliers(model, target, state);
  for (std::size_t m = 0; m < held_.prescribed.size(); ++m) {
    std::vector<int>& drivers = held_.prescribed[m].drivers;
    if (drivers.empty()) continue;
    double& multiplier = state.multipliers[m];
    for (const int driver : drivers) held_.load_factors[at(driver)] = multiplier;
    factors_.emplace_back(m, multiplier);
    multiplier = 0;
    drivers.clear();
  }
}

void HeldDrivers::give_back(State& state) const {
  for (const auto& [multiplier, factor] : factors_)
    if (multiplier < state.multipliers.size()) state.multipliers[multiplier] = factor;
}

}  // namespace genu
