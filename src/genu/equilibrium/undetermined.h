// Undetermined parts of an equilibrium: motions at no cost, statically indeterminate forces.
#pragma once

#include <vector>

#include "genu/equilibrium/stability.h"

namespace genu {

struct Undetermined {
  std::vector<CoordinateRef> free_motion;     ///< coordinates that change along a motion at no cost
  std::vector<QuantityRef> shared_reactions;  ///< prescribed or held quantities without a unique reaction
  std::vector<int> shared_contacts;           ///< contacts without a unique force: indices into State::contacts
  std::vector<int> shared_ligaments;          ///< ligaments held at a jump without a unique force
  bool none() const {
    return free_motion.empty() && shared_reactions.empty() && shared_contacts.empty() && shared_ligaments.empty();
  }
};

/// From the stability of a pose. `state` and `target` are those it was assessed at.
Undetermined find_undetermined(const JointModel& model, const State& state, const Target& target,
                               const Stability& stability);

}  // namespace genu
