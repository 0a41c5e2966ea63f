#include "genu/model/damping.h"

#include <algorithm>

#include "genu/model/bushing_forces.h"
#include "genu/model/ligament_pieces.h"
#include "genu/model/linearization.h"
#include "genu/model/twist.h"

namespace genu {

bool pushes(const LigamentLaw& law) { return law.slack_until() < 0; }

double damper_tension(const JointModel::Ligament& ligament, DamperMode mode, double force, double rate) {
  if (mode == DamperMode::slack) return 0;
  return mode == DamperMode::taut ? ligament.damping * rate : -force;
}

std::vector<DamperMode> damper_modes(const JointModel& model, const State& state, const VecX& twist) {
  std::vector<DamperMode> modes(model.ligaments.size(), DamperMode::taut);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto& l = model.ligaments[i];
    if (l.damping == 0 || pushes(l.law)) continue;
    const LigamentShown shown = show_ligament(model, state, static_cast<int>(i));
    const double rate = l.path.length_rate(state.poses, twist, state.wraps);
    if (shown.length <= l.law.slack_until())
      modes[i] = DamperMode::slack;
    else if (shown.force + l.damping * rate < 0)
      modes[i] = DamperMode::relaxed;
  }
  return modes;
}

std::size_t damper_count(const JointModel& model) {
  const auto ligaments =
      std::count_if(model.ligaments.begin(), model.ligaments.end(), [](const auto& l) { return l.damping != 0; });
  const auto layers =
      std::count_if(model.layers.begin(), model.layers.end(), [](const auto& l) { return l.damping != 0; });
  const auto bushings =
      std::count_if(model.bushings.begin(), model.bushings.end(), [](const auto& b) { return !b.damping.isZero(0); });
  return model.joint_dampers.size() + static_cast<std::size_t>(ligaments + layers + bushings);
}

double add_damping(const JointModel& model, const State& state, const std::vector<DamperMode>& modes, const VecX& twist,
                   VecX& wrench) {
  double power = 0;
  for (std::size_t i = 0; i < model.ligaments.size(); ++i) {
    const auto& l = model.ligaments[i];
    if (l.damping == 0 || modes[i] == DamperMode::slack) continue;
    const double rate = l.path.length_rate(state.poses, twist, state.wraps);
    const double tension = damper_tension(l, modes[i], show_ligament(model, state, static_cast<int>(i)).force, rate);
    power += tension * rate;
    l.path.add_tension(state.poses, tension, wrench, state.wraps);
  }
  for (const auto& damper : model.joint_dampers) {
    const JointPoint::Gradient gradient = joint_point(model, state, damper.joint).gradient(0);
    const double rate = gradient.dot(twist_of_pair(model, damper.joint, twist));
    power += damper.damping * rate * rate;
    add_to_pair(model, damper.joint, Vec12(-damper.damping * rate * gradient.transpose()), wrench);
  }
  return power + add_bushing_dampers(model, state, twist, wrench);
}

}  // namespace genu
