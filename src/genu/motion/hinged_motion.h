// The equations of motion of bodies on hinges alone, in the angles of these: y = [angles; rates; work of loads;
// dissipated], with no constraint to keep and none to solve for (model/hinge_tree.h).
#pragma once

#include "genu/motion/hinge_tree.h"
#include "genu/motion/ode_integrator.h"
#include "genu/motion/wrenches.h"

namespace genu {

class HingedMotion {
 public:
  /// Whether that is all there is: a tree of hinges without contacts, layers and prescribed coordinates.
  static bool fits(const JointModel& model) {
    return HingeTree::describes(model) && model.drives.empty() && model.pairs.empty() && model.layers.empty();
  }

  explicit HingedMotion(const JointModel& model);

  Eigen::Index size() const { return 2 * tree_.count() + 2; }

  /// Angles and rates of a state on the hinges, into the first 2 count() numbers of y.
  void pack(const State& state, const VecX& twist, Eigen::Ref<VecX> y) const;

  /// The poses, coordinates and twists that y means.
  void place(OdeSystem::Values y, State& state, VecX& twist);

  /// y', at the state that place() has set last.
  bool rate(const State& state, const VecX& twist, const Target& target, const std::vector<DamperMode>& modes,
            Eigen::Ref<VecX> out);

  /// 1 / (error allowed in each number in a step), for angles and rates; `second` is what rates are small in (s).
  void weights(OdeSystem::Values y, double tolerance, double second, Eigen::Ref<VecX> out) const;

 private:
  double add_hinge_moments(const State& state, const Target& target);

  const JointModel& model_;
  HingeTree tree_;
  VecX angles_, rates_, accelerations_, moments_, wrench_;
  std::size_t damper_count_;
};

}  // namespace genu
