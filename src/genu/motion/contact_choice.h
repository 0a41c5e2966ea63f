// Which of the contacts that touch stay closed: the complementarity problem of one-sided constraints, each closed with
// a force that presses or open and not closing. With the few contacts of a joint it is solved by trying the sets, the
// largest first.
#pragma once

#include "genu/motion/equations_of_motion.h"

namespace genu {

/// Speeds of `point` after an inelastic impact on the contacts it has: impulses press, and what they leave open does
/// not close. Contacts that part are taken out, but for those that forces bring back before they are open by
/// `touching` (m). False where no set is possible.
bool settle_speeds(const JointModel& model, EquationsOfMotion& equations, double touching, MotionPoint& point);

/// Accelerations and forces of `point`: forces press, and what they leave open does not begin to close. Contacts that
/// part are taken out; contact `leaves` (-1: none) is one of them. False where no set is possible.
bool settle_forces(const JointModel& model, EquationsOfMotion& equations, MotionPoint& point, int leaves);

}  // namespace genu
