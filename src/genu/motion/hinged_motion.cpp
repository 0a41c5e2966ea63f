#include "genu/motion/hinged_motion.h"

#include "genu/model/linearization.h"
#include "genu/model/twist.h"

namespace genu {

HingedMotion::HingedMotion(const JointModel& model) : model_(model), tree_(model), damper_count_(damper_count(model)) {
  angles_.resize(tree_.count());
  rates_.resize(tree_.count());
  accelerations_.resize(tree_.count());
  moments_.resize(tree_.count());
  wrench_.resize(6 * model.moving_count);
}

void HingedMotion::pack(const State& state, const VecX& twist, Eigen::Ref<VecX> y) const {
  for (Eigen::Index i = 0; i < tree_.count(); ++i) {
    const int joint = tree_.joint(i);
    y[i] = state.coordinates[at(joint)][0];
    y[tree_.count() + i] = joint_point(model_, state, joint).gradient(0).dot(twist_of_pair(model_, joint, twist));
  }
}

void HingedMotion::place(OdeSystem::Values y, State& state, VecX& twist) {
  angles_ = y.head(tree_.count());
  rates_ = y.segment(tree_.count(), tree_.count());
  tree_.place(angles_, rates_, state, twist);
}

/// Springs and loads about the hinges. Returns the power of the loads, W.
double HingedMotion::add_hinge_moments(const State& state, const Target& target, const VecX& twist) {
  EffectMeter* meter = model_.meter.get();
  evaluate_effect(meter, Effect::joint_springs, model_.joint_springs.size(), [&] {
    for (const JointSpring& spring : model_.joint_springs)
      if (const int i = tree_.hinge({spring.joint, 0}); i >= 0) moments_[i] += spring.moment(angles_[i]);
  });
  double power = 0;
  for (std::size_t k = 0; k < model_.loads.size(); ++k) {
    const Load& load = model_.loads[k];
    const int i = load.kind == Load::Kind::coordinate ? tree_.hinge(load.coordinate) : -1;
    if (i < 0) continue;
    const double moment =
        target.load_factors[k] * load_scale_in_motion(model_, load, state, target.time, twist) * load.value;
    moments_[i] += moment;
    power += moment * rates_[i];
  }
  return power;
}

bool HingedMotion::rate(const State& state, const VecX& twist, const Target& target,
                        const std::vector<DamperMode>& modes, Eigen::Ref<VecX> out) {
  EffectMeter* meter = model_.meter.get();
  const Eigen::Index n = tree_.count();
  wrench_.setZero();
  moments_.setZero();
  double power = 0, taken = 0;
  evaluate_effect(meter, Effect::ligaments, model_.ligaments.size(),
                  [&] { taken = add_ligament_wrenches(model_, state, modes, twist, wrench_); });
  evaluate_effect(meter, Effect::loads, model_.loads.size(),
                  [&] { power = add_load_wrenches(model_, state, target, twist, wrench_); });
  evaluate_effect(meter, Effect::weights, model_.weights.size(), [&] { add_weight_wrenches(model_, state, wrench_); });
  power += add_hinge_moments(state, target, twist);
  evaluate_effect(meter, Effect::damping, damper_count_, [&] {
    for (const auto& damper : model_.joint_dampers) {
      const int i = tree_.hinge({damper.joint, 0});
      if (i < 0) continue;
      moments_[i] -= damper.damping * rates_[i];
      taken += damper.damping * rates_[i] * rates_[i];
    }
  });
  bool good = false;
  evaluate_effect(meter, Effect::inertia, model_.inertias.size(),
                  [&] { good = tree_.accelerate(state, wrench_, moments_, accelerations_); });
  out.head(n) = rates_;
  out.segment(n, n) = accelerations_;
  out[2 * n] = power;
  out[2 * n + 1] = taken;
  return good && out.allFinite();
}

void HingedMotion::weights(const OdeSystem::Values& y, double tolerance, double second, Eigen::Ref<VecX> out) const {
  const Eigen::Index n = tree_.count();
  out.head(n).setConstant(1 / tolerance);
  for (Eigen::Index i = 0; i < n; ++i) out[n + i] = 1 / (tolerance * (1 / second + std::abs(y[n + i])));
}

}  // namespace genu
