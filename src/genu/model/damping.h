// Dampers of a motion: along ligaments and about revolute joints.
//
// A damped ligament has the tension F(L) + D L'. One that cannot push (its law has a slack side) has no damper while it
// is slack, and loses all tension where F + D L' would push: which of these holds is its mode, fixed between events so
// that the forces are smooth while a step is taken. A joint's damper has the moment -D q' on its angle.
#pragma once

#include <vector>

#include "genu/model/state.h"

namespace genu {

enum class DamperMode {
  slack,   ///< no damper: the law itself has no force
  taut,    ///< F + D L'
  relaxed  ///< long enough to be taut, but shortening so fast that the tension is 0
};

/// Whether a ligament's law has no side on which it is slack: its damper acts both ways and at any length.
bool pushes(const LigamentLaw& law);

/// The tension that a damper adds to the law's `force` (N), for the ligament's mode. `rate`: L' in m/s.
double damper_tension(const JointModel::Ligament& ligament, DamperMode mode, double force, double rate);

/// The modes that lengths and velocities ask for; one for each ligament, `taut` for those without damping.
std::vector<DamperMode> damper_modes(const JointModel& model, const State& state, const VecX& twist);

/// Joints, ligaments and elastic layers that have one.
std::size_t damper_count(const JointModel& model);

/// Adds the wrenches (6 for each moving body) of all dampers to `wrench`. Returns what they dissipate, W: with -F L' of
/// a relaxed ligament, whose stored energy goes to nobody.
double add_damping(const JointModel& model, const State& state, const std::vector<DamperMode>& modes, const VecX& twist,
                   VecX& wrench);

}  // namespace genu
