// Counts the evaluations of each effect of a scene and estimates their time.
//
// An effect is a kind of term in the equations: ligaments, loads, contact and so on. Only effects that a scene names
// are evaluated, and this meter shows it. Quick terms are timed on every sixteenth call and scaled, because reading the
// clock would cost as much as they do. The first call, with cold caches, and slow terms are always timed and never
// scaled.
#pragma once

#include <array>
#include <cstdint>

#include "genu/core/timer.h"

namespace genu {

enum class Effect {
  prescribed,     ///< prescribed coordinates, or driven ones in motion
  held,           ///< coordinates held by joints
  joint_springs,  ///< stiffness and limits of joints
  bushings,
  ligaments,
  loads,
  weights,
  rigid_contacts,  ///< the equations of a contact
  contact_search,  ///< searches of all pairs for contacts
  layers,          ///< elastic layers, with their tangents
  inertia,         ///< of moving bodies, in motion
  damping,         ///< of joints and ligaments, in motion
};
inline constexpr std::size_t kEffects = 12;

class EffectMeter {
 public:
  /// Runs `work`, which evaluates `count` terms.
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

  /// Measured calls, plus an estimate for the others.
  double seconds(Effect effect) const {
    const Tally& tally = tallies_[static_cast<std::size_t>(effect)];
    if (tally.timed == 0) return tally.seconds;
    return tally.seconds +
           tally.sampled_seconds * static_cast<double>(tally.sampled) / static_cast<double>(tally.timed);
  }

 private:
  static constexpr std::int64_t kEvery = 16;
  static constexpr double kSlow = 10e-6;  // s per call, beside which reading the clock costs nothing
  struct Tally {
    std::int64_t evaluations = 0, sampled = 0, timed = 0;  // timed: number of sampled calls
    double seconds = 0, sampled_seconds = 0;
    bool begun = false;
  };
  std::array<Tally, kEffects> tallies_;
};

/// Runs `work` if there is anything to evaluate, and counts it if there is a meter.
template <typename Work>
void evaluate_effect(EffectMeter* meter, Effect effect, std::size_t count, const Work& work) {
  if (count == 0) return;
  if (meter != nullptr)
    meter->measure(effect, count, work);
  else
    work();
}

}  // namespace genu
