// A balanced pose of the same joint with its surfaces lying on an elastic foundation, stiffened until it is nearly
// rigid. It can be solved from almost anywhere (overlapping, apart, another contact set) and tells rigid contact where
// to begin.
#pragma once

#include "genu/model/contact_field.h"
#include "genu/solver/newton_step.h"

namespace genu {

struct SeedReport {
  bool balanced = false;
  int iterations = 0;
  double deepest = 0;  ///< overlap that is left, m
};

/// Moves `state` (poses and multipliers; its contacts are emptied) to the compliant equilibrium for `target`.
SeedReport compliant_seed(const JointModel& model, ContactField& field, const Target& target, State& state,
                          double stiffer = 1);

}  // namespace genu
