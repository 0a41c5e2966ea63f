#include "genu/model/potential_energy.h"

#include "genu/model/ligament_pieces.h"
#include "genu/model/linearization.h"

namespace genu {
namespace {

/// Potential of a load that has one, with factor 1: J up to a constant.
double potential(const Load& load, const std::vector<Pose>& poses, double coordinate) {
  switch (load.kind) {
    case Load::Kind::dead:
      return -load.force.dot(poses[at(load.body_a)] * load.p_A);
    case Load::Kind::toward:
      return load.value * (poses[at(load.body_b)] * load.p_B - poses[at(load.body_a)] * load.p_A).norm();
    case Load::Kind::coordinate:
      return -load.value * coordinate;
    case Load::Kind::cable:
    case Load::Kind::follower:
      break;
  }
  return 0;
}

double since_reference(const JointModel& model, const State& state, const Load& load) {
  double now = 0, before = 0;
  if (load.kind == Load::Kind::coordinate) {
    const auto joint = at(load.coordinate.joint), index = at(load.coordinate.index);
    now = state.coordinates[joint][index];
    before = model.joints[joint].reference[index];
  }
  if (load.kind == Load::Kind::cable)
    return load.value * (load.path.length(state.poses, state.wraps) -
                         load.path.length(model.reference_poses, model.reference_wraps));
  return potential(load, state.poses, now) - potential(load, model.reference_poses, before);
}

}  // namespace

double stored_energy(const JointModel& model, const State& state) {
  double energy = 0;
  for (const auto& l : model.ligaments) energy += l.law.evaluate(l.path.length(state.poses, state.wraps)).energy;
  for (const JointSpring& spring : model.joint_springs) energy += spring.energy(state.coordinates[at(spring.joint)][0]);
  for (const Bushing& b : model.bushings) energy += energy_of(b, state.poses[at(b.body_a)], state.poses[at(b.body_b)]);
  return energy;
}

bool has_potential(const Load& load) {
  if (load.scale && load.scale->coordinate()) return false;
  if (load.kind == Load::Kind::dead) return load.moment.isZero(0);
  return load.kind != Load::Kind::follower;
}

std::optional<double> potential_energy(const JointModel& model, const State& state, const Target& target) {
  if (!model.layers.empty()) return std::nullopt;
  double energy = stored_energy(model, state);
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const double given = load_factor(target, state, i), factor = given * load_scale(load, state, target.time).factor;
    const bool over_coordinate = load.scale && load.scale->coordinate();  // the factor may be 0 here, but not nearby
    if (given == 0 || (factor == 0 && !over_coordinate)) continue;
    if (!has_potential(load)) return std::nullopt;
    energy += factor * since_reference(model, state, load);
  }
  for (const Load& weight : model.weights) energy += since_reference(model, state, weight);
  return energy;
}

}  // namespace genu
