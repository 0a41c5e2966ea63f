#include "genu/motion/motion_rates.h"

#include "genu/model/linearization.h"
#include "genu/model/potential_energy.h"
#include "genu/model/twist.h"

namespace genu {
std::vector<JointValues> coordinate_rates(const JointModel& model, const State& state, const VecX& twist) {
  std::vector<JointValues> rates(model.joints.size());
  for (std::size_t j = 0; j < rates.size(); ++j) {
    const JointPoint point = joint_point(model, state, static_cast<int>(j));
    const Vec12 pair = twist_of_pair(model, static_cast<int>(j), twist);
    for (int i = 0; i < 6; ++i) rates[j][at(i)] = point.gradient(i).dot(pair);
  }
  return rates;
}

VecX centripetal_rates(const JointModel& model, const State& state, const Target& target, const VecX& twist) {
  VecX out = VecX::Zero(static_cast<Eigen::Index>(constraint_count(model, target)));
  JointPoint point;
  Vec12 pair;
  int evaluated = -1;
  Eigen::Index row = 0;
  const auto add = [&](const CoordinateRef& c, double factor) {
    if (c.joint != evaluated) {
      point = joint_point(model, state, evaluated = c.joint);
      pair = twist_of_pair(model, evaluated, twist);
    }
    out[row] += factor * pair.dot(point.hessian(c.index) * pair);
  };
  for (const auto& p : target.prescribed) {
    for_terms(model, p.coordinate, add);
    ++row;
  }
  for (const auto& held : model.held) {
    add(held.coordinate, 1);
    ++row;
  }
  return out;
}

double load_power(const JointModel& model, const State& state, const Target& target, const VecX& twist) {
  double power = 0;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const double factor = target.load_factors[i] * load_scale_in_motion(model, load, state, target.time, twist);
    if (factor == 0) continue;
    if (load.kind == Load::Kind::cable) {
      power -= factor * load.value * load.path.length_rate(state.poses, twist, state.wraps);
      continue;
    }
    const Vec12 wrench = load_wrench(model, state, load).wrench;
    power += factor * (wrench.head<6>().dot(twist_of_body(model, load.body_a, twist)) +
                       wrench.tail<6>().dot(twist_of_body(model, load.body_b, twist)));
  }
  return power;
}

MechanicalEnergy mechanical_energy(const JointModel& model, const State& state, const VecX& twist) {
  MechanicalEnergy energy;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (const int k = model.bodies[i].moving; k >= 0)
      energy.kinetic += kinetic_energy(model.inertias[at(k)], state.poses[i].R, twist.segment<6>(6 * k));
  energy.stored = stored_energy(model, state);
  for (const Load& weight : model.weights)
    energy.gravity -= weight.force.dot(state.poses[at(weight.body_a)] * weight.p_A -
                                       model.reference_poses[at(weight.body_a)] * weight.p_A);
  return energy;
}

}  // namespace genu
