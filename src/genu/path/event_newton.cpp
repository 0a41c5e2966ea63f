#include "genu/path/event_newton.h"

#include <cmath>

#include "genu/model/layer_levels.h"
#include "genu/model/ligament_pieces.h"
#include "genu/path/tolerances.h"

namespace genu {

/// Sets correction_ to the step of all unknowns: of the pose, and of the path's parameter (`parameter`) such that the
/// length is right to first order.
bool EventNewton::correct(const StepPlan& plan, const Asked& asked, double t, const State& state, double past) {
  const Target target = plan.target(t), rate = plan.rate();
  if (!step_.factor(here_, target) || !step_.linear().full_rank()) return false;
  step_.solve(here_, correction_);
  step_.solve_rates(load_rate(*model_, state, target, rate), constraint_rate(rate, here_.constraint.size()), motion_);
  const auto& ligament = model_->ligaments[at(asked.ligament)];
  const double fast = ligament.path.length_rate(state.poses, motion_.twist, state.wraps);
  const double along = -(past + ligament.path.length_rate(state.poses, correction_.twist, state.wraps)) / fast;
  if (!std::isfinite(along)) return false;
  correction_.add(along, motion_);
  correction_.parameter = along;
  return true;
}

bool EventNewton::solve(const StepPlan& plan, const Asked& asked, const NewtonOptions& options,
                        const std::shared_ptr<LayerMemories>& layers, double& t, State& state) {
  here_.layers = layers;
  double last = 1, before = 0, length = 0;  // of t; of the residual; of the last correction
  for (int i = 0; i <= kMaxEventIterations; ++i) {
    const Target target = plan.target(t);
    linearize(*model_, state, target, here_);
    if (asked_to_stop(options.cancelled)) return false;
    const double residual = step_.residual(here_, target);
    const double past = model_->ligaments[at(asked.ligament)].path.length(state.poses, state.wraps) - asked.length;
    if (!std::isfinite(residual) || !correct(plan, asked, t, state, past)) return false;
    const double along = correction_.parameter;
    const bool there = std::abs(past) <= asked.rounding || std::abs(along) <= asked.tolerance;
    const bool stalled = i > 0 && residual > 0.5 * before && residual <= options.residual_floor;
    before = residual;
    if ((residual <= options.residual_tolerance || stalled) && there) {
      if (!raise_layer_levels(*model_, here_, state)) {
        if (std::abs(past) > asked.rounding) t += along;
        return true;
      }
      continue;
    }
    if (std::abs(along) > last || !retract(*model_, state, correction_, 1, trial_)) return false;
    // Corrections that shrink like this leave less than the next one, which need not be computed.
    const double shrinks = i > 0 ? step_.norm(correction_) / length : 1;
    length = step_.norm(correction_);
    const bool small = model_->layers.empty() && shrinks <= kEventContraction && shrinks * length <= kEventError &&
                       shrinks * std::abs(along) <= kEventContraction * asked.tolerance;
    last = std::max(std::abs(along), asked.tolerance);
    std::swap(state, trial_);
    t += along;
    if (small && !raise_layer_levels(*model_, here_, state)) return true;
  }
  return false;
}

}  // namespace genu
