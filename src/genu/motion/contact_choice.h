// The active set of touching contacts in motion: a complementarity problem. Each contact is closed with a compressive
// force, or open and not closing. A joint has few contacts, so the sets are tried one by one, the largest first.
#pragma once

#include "genu/motion/equations_of_motion.h"

namespace genu {

/// Velocities of `point` after an inelastic impact on its contacts: impulses are compressive, and open contacts do not
/// close. Separating contacts are removed, except those that the forces close again before they are open by `touching`
/// (m). False where no set is possible.
bool settle_speeds(const JointModel& model, EquationsOfMotion& equations, double touching, MotionPoint& point);

/// Accelerations and forces of `point`: forces are compressive, and open contacts do not begin to close. Separating
/// contacts are removed; contact `leaves` (-1: none) is one of them. False where no set is possible.
bool settle_forces(const JointModel& model, EquationsOfMotion& equations, MotionPoint& point, int leaves);

}  // namespace genu
