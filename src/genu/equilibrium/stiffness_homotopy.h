// A balanced pose of the same joint with its surfaces lying on an elastic foundation, stiffened until it is nearly
// rigid. It can be solved from almost anywhere (overlapping, apart, another contact set) and tells rigid contact where
// to begin.
#pragma once

#include <functional>

#include "genu/core/cancelled.h"
#include "genu/equilibrium/newton_step.h"
#include "genu/model/contact_field.h"

namespace genu {

struct SeedReport {
  bool balanced = false;
  int iterations = 0;
  double deepest = 0;  ///< overlap that is left, m
};

/// Moves `state` (poses and multipliers; its contacts are emptied) to the compliant equilibrium for `target`. The first
/// foundation is `stiffer` times the usual one: what is soft for the forces at hand lets a body through a thin sheet.
/// Not balanced where it is `cancelled`.
SeedReport stiffness_homotopy(const JointModel& model, ContactField& field, const Target& target, State& state,
                              double stiffer = 1, const Cancelled& cancelled = {});

/// Balances a state on a foundation of `modulus` (Pa per m of overlap); false where that fails. Updates its part of the
/// report.
using SeedStage = std::function<bool(double modulus, State& state, SeedReport& report)>;

/// The stages of a seed, each on a stiffer foundation, until little overlap is left or one of them fails.
SeedReport stiffen(const JointModel& model, const Target& target, State& state, const SeedStage& stage,
                   double stiffer = 1);

}  // namespace genu
