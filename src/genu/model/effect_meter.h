// What each effect of a scene costs: how often it was evaluated, and about how long that took.
//
// An effect is a kind of term in the equations: ligaments, loads, contact and so on. A scene pays only for those it
// names, and this is where that is counted. The time of quick terms is of every sixteenth call and scaled: looking at
// the clock each time would cost as much as they do. The first call, which may find nothing in the caches, and terms
// that are slow are timed each time and never scaled.
#pragma once

#include <array>
#include <cstdint>

#include "genu/core/timer.h"

namespace genu {

enum class Effect {
  prescribed,     ///< coordinates that are prescribed, or driven over time
  held,           ///< coordinates that joints hold
  joint_springs,  ///< stiffness and limits of joints
  ligaments,
  loads,
  weights,
  rigid_contacts,  ///< the equations of a contact
  contact_search,  ///< surveys of all pairs for contacts
  layers,          ///< elastic layers, with their tangents
  inertia,         ///< of moving bodies, in motion
  damping,         ///< of joints and ligaments, in motion
};
inline constexpr std::size_t kEffects = 11;

class EffectMeter {
 public:
  /// Does `work`, which evaluates `count` things of a kind.
  template <typename Work>
  void measure(Effect effect, std::size_t count, const Work& work) {
    Tally& tally = tallies_[static_cast<std::size_t>(effect)];
    tally.evaluations += static_cast<std::int64_t>(count);
    if (!tally.begun || tally.sampled_seconds > kSlow * static_cast<double>(tally.timed)) {
      tally.begun = true;
      const ScopedTimer timing(tally.seconds);
      return work();
    }
    if (tally.sampled++ % kEvery != 0) return work();
    ++tally.timed;
    const ScopedTimer timing(tally.sampled_seconds);
    work();
  }

  std::int64_t evaluations(Effect effect) const { return tallies_[static_cast<std::size_t>(effect)].evaluations; }

  /// Of the calls that were timed, and about that of the others.
  double seconds(Effect effect) const {
    const Tally& tally = tallies_[static_cast<std::size_t>(effect)];
    if (tally.timed == 0) return tally.seconds;
    return tally.seconds +
           tally.sampled_seconds * static_cast<double>(tally.sampled) / static_cast<double>(tally.timed);
  }

 private:
  static constexpr std::int64_t kEvery = 16;
  static constexpr double kSlow = 10e-6;  // s a call, beside which a look at the clock is nothing
  struct Tally {
    std::int64_t evaluations = 0, sampled = 0, timed = 0;  // timed: of those that are sampled
    double seconds = 0, sampled_seconds = 0;
    bool begun = false;
  };
  std::array<Tally, kEffects> tallies_;
};

/// Does `work` where there is something to evaluate, and counts it where there is a meter.
template <typename Work>
void evaluate_effect(EffectMeter* meter, Effect effect, std::size_t count, const Work& work) {
  if (count == 0) return;
  if (meter != nullptr)
    meter->measure(effect, count, work);
  else
    work();
}

}  // namespace genu
