// What of an equilibrium is not determined: motions that cost no force, forces that can be traded for one another.
#pragma once

#include <vector>

#include "genu/equilibrium/stability.h"

namespace genu {

struct Undetermined {
  std::vector<CoordinateRef> free_motion;     ///< coordinates that change along some motion that costs no force
  std::vector<QuantityRef> shared_reactions;  ///< what is prescribed or held, without a reaction of its own
  std::vector<int> shared_contacts;           ///< the same of contacts: indices into State::contacts
  std::vector<int> shared_ligaments;          ///< of ligaments held at a jump of their force
  bool none() const {
    return free_motion.empty() && shared_reactions.empty() && shared_contacts.empty() && shared_ligaments.empty();
  }
};

/// Reads it from the stability of a pose; `state` and `target` are those it was assessed at.
Undetermined find_undetermined(const JointModel& model, const State& state, const Target& target,
                               const Stability& stability);

}  // namespace genu
