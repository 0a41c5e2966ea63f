// The equations of motion of bodies connected by hinges only, in the hinge angles: y = [angles; rates; work of loads;
// dissipated energy]. There are no constraints (hinge_tree.h).
#pragma once

#include <algorithm>

#include "genu/motion/hinge_tree.h"
#include "genu/motion/ode_integrator.h"
#include "genu/motion/wrenches.h"

namespace genu {

class HingedMotion {
 public:
  /// Whether the model has this form: a tree of hinges without contacts, layers, bushings and prescribed coordinates.
  static bool fits(const JointModel& model) {
    return HingeTree::describes(model) && model.drives.empty() && model.pairs.empty() && model.layers.empty() &&
           model.bushings.empty() && model.reference_wraps.empty() &&
           std::none_of(model.loads.begin(), model.loads.end(),
                        [](const Load& load) { return load.kind == Load::Kind::cable; });
  }

  explicit HingedMotion(const JointModel& model);

  Eigen::Index size() const { return 2 * tree_.count() + 2; }

  /// Angles and rates of a state on the hinges, into the first 2 count() numbers of y.
  void pack(const State& state, const VecX& twist, Eigen::Ref<VecX> y) const;

  /// The poses, coordinates and twists of y.
  void place(OdeSystem::Values y, State& state, VecX& twist);

  /// y', at the state that place() has set last.
  bool rate(const State& state, const VecX& twist, const Target& target, const std::vector<DamperMode>& modes,
            Eigen::Ref<VecX> out);

  /// 1 / (allowed error of each number in one step), for angles and rates; `second` (s): rates are measured in rad per
  /// it.
  void weights(const OdeSystem::Values& y, double tolerance, double second, Eigen::Ref<VecX> out) const;

 private:
  double add_hinge_moments(const State& state, const Target& target, const VecX& twist);

  const JointModel& model_;
  HingeTree tree_;
  VecX angles_, rates_, accelerations_, moments_, wrench_;
  std::size_t damper_count_;
};

}  // namespace genu
