// Dampers in motion: along ligaments and about revolute joints.
//
// A damped ligament has the tension F(L) + D L'. A ligament that cannot push (its law has a slack side) has no damper
// while it is slack, and tension 0 where F + D L' would be negative. Its mode says which case holds. Modes are constant
// between events, so that forces are smooth within a step. A joint's damper has the moment -D q' on its angle.
#pragma once

#include <vector>

#include "genu/model/state.h"

namespace genu {

enum class DamperMode {
  slack,   ///< no damper: the law itself has no force
  taut,    ///< F + D L'
  relaxed  ///< longer than slack, but shortening so fast that the tension is 0
};

/// Whether a law has no slack side: its damper acts both ways and at any length.
bool pushes(const LigamentLaw& law);

/// The tension that a damper adds to the `force` of the law (N), in the ligament's mode. `rate`: L' in m/s.
double damper_tension(const JointModel::Ligament& ligament, DamperMode mode, double force, double rate);

/// The modes for given lengths and velocities, one for each ligament; `taut` without damping.
std::vector<DamperMode> damper_modes(const JointModel& model, const State& state, const VecX& twist);

/// Number of joints, ligaments and elastic layers with damping.
std::size_t damper_count(const JointModel& model);

/// Adds the wrenches (6 for each moving body) of all dampers to `wrench`. Returns the dissipated power, W. It includes
/// -F L' of relaxed ligaments, whose stored energy is lost.
double add_damping(const JointModel& model, const State& state, const std::vector<DamperMode>& modes, const VecX& twist,
                   VecX& wrench);

}  // namespace genu
