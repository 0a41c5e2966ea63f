// Homotopy in contact stiffness: an equilibrium with the surfaces on an elastic foundation, which is stiffened until it
// is nearly rigid. It can be solved from almost anywhere (overlapping, apart, another active set) and gives rigid
// contact its start.
#pragma once

#include <functional>

#include "genu/core/cancelled.h"
#include "genu/equilibrium/newton_step.h"
#include "genu/model/contact_field.h"

namespace genu {

struct SeedReport {
  bool balanced = false;
  int iterations = 0;
  double deepest = 0;  ///< remaining overlap, m
  State ended;         ///< where the first stage ended, if that failed
};

/// Moves `state` (poses and multipliers; its contacts are removed) to the compliant equilibrium for `target`.
/// `stiffer`: factor on the modulus of the first foundation. A foundation too soft for the forces lets a body pass
/// through a thin sheet. Not balanced where it is `cancelled`.
SeedReport stiffness_homotopy(const JointModel& model, ContactField& field, const Target& target, State& state,
                              double stiffer = 1, const Cancelled& cancelled = {});

/// Balances a state on a foundation of `modulus` (Pa per m of overlap) and updates its part of the report. False where
/// that fails.
using SeedStage = std::function<bool(double modulus, State& state, SeedReport& report)>;

/// Runs stages on stiffer and stiffer foundations until the overlap is small or one of them fails.
SeedReport stiffen(const JointModel& model, const Target& target, State& state, const SeedStage& stage,
                   double stiffer = 1);

}  // namespace genu
