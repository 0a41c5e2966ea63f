// Seeds need a potential: while they search, loads that drive coordinates are dead loads with the factors found so far,
// and reactions hold the coordinates.
#pragma once

#include "genu/model/state.h"

namespace genu {

class HeldDrivers {
 public:
  /// `state` gets a multiplier for each constraint of `target`; those of driven coordinates become reactions, 0 at
  /// first.
  HeldDrivers(const JointModel& model, const Target& target, State& state);

  const Target& target() const { return held_; }

  /// Puts the factors back in the place of the reactions.
  void give_back(State& state) const;

 private:
  Target held_;
  std::vector<std::pair<std::size_t, double>> factors_;  ///< of the driven coordinates, by their multiplier
};

/// What `seed` finds from `state` with the drivers held.
template <typename Seed>
auto with_held_drivers(const JointModel& model, const Target& target, State& state, const Seed& seed) {
  const HeldDrivers held(model, target, state);
  auto found = seed(held.target());
  held.give_back(state);
  return found;
}

}  // namespace genu
