// Damped Newton's method on manifolds for one pose with a given active set.
#pragma once

#include <string>

#include "genu/core/cancelled.h"
#include "genu/equilibrium/newton_step.h"

namespace genu {

struct NewtonOptions {
  /// Scaled residual (see NewtonStep::residual) at which a pose is solved. Quadratic convergence ends far below it.
  /// Where rounding ends convergence earlier, a residual below `residual_floor` is accepted and reported.
  double residual_tolerance = 1e-12;
  double residual_floor = 1e-8;
  int max_iterations = 40;
  double smallest_damping = 1.0 / 1024;
  double max_translation = 0.15;  ///< largest translation of a body's origin in one iteration, of the model's size
  double max_rotation = 0.1;      ///< rad
  double max_slide = 0.2;         ///< largest motion of a contact point in one iteration, of the model's size
  NewtonStep::Route route = NewtonStep::Route::automatic;
  Cancelled cancelled;  ///< asked in every iteration and while layers are summed
};

/// The same options, cancelled by `cancelled`.
inline NewtonOptions stoppable(NewtonOptions options, const Cancelled& cancelled) {
  options.cancelled = cancelled;
  return options;
}

struct NewtonReport {
  enum class Outcome { converged, iterations_used_up, no_descent, left_the_surface, not_finite, cancelled };
  Outcome outcome = Outcome::not_finite;
  int iterations = 0;
  double residual = 0;        ///< scaled, at the state returned
  double rcond = 0;           ///< of the last Jacobian, scaled
  bool full_rank = true;      ///< of the last Jacobian
  bool minimum_norm = false;  ///< the last Jacobian was too ill-conditioned for LU
  /// The last three residuals, oldest first. `simplified`: the step to it used the Jacobian of the iterate before.
  double residual_history[3] = {0, 0, 0};
  bool simplified_history[3] = {false, false, false};

  /// Appends a residual to the history.
  void remember(double next, bool simplified);
  bool converged() const { return outcome == Outcome::converged; }
};

std::string to_string(NewtonReport::Outcome outcome);

/// Newton's method with Deuflhard's affine-invariant monotonicity test (P. Deuflhard, Newton Methods for Nonlinear
/// Problems, 2004, section 3.3). Keeps its memory between solves.
class Newton {
 public:
  explicit Newton(const JointModel& model) : model_(&model), step_(model) {}
  Newton(const Newton&) = delete;
  Newton& operator=(const Newton&) = delete;

  /// Solves from `state` in place. Repeats the solve where elastic layers need a finer quadrature (layer_levels.h). On
  /// failure `state` is unchanged.
  NewtonReport solve(State& state, const Target& target, const NewtonOptions& options);

  /// After a converged solve: the linearization at the solution. Derivatives are evaluated now if no step needed them.
  const Linearization& linearization();
  /// What earlier poses have shown of the elastic layers.
  const std::shared_ptr<LayerMemories>& layers() const { return here_->layers; }

  /// After a converged solve: bound on the relative difference between the Jacobian that step() has factored and the
  /// one at the solution; 0 where they are the same.
  double jacobian_error() const { return jacobian_error_; }
  /// Factors the Jacobian at the solution for step(). False where that fails.
  [[nodiscard]] bool factor_at_solution(NewtonStep::Route route = NewtonStep::Route::automatic);

  NewtonStep& step() { return step_; }

 private:
  void solve_as_fine(const NewtonOptions& options, NewtonReport& report);
  [[nodiscard]] bool factor(const NewtonOptions& options, NewtonReport& report);
  void complete();
  void polish(const NewtonOptions& options, NewtonReport& report);
  double admissible_fraction(const Correction& correction, const NewtonOptions& options) const;
  double simplified_norm();
  [[nodiscard]] bool advance(const NewtonOptions& options, double& residual, NewtonReport& report);

  const JointModel* model_;
  NewtonStep step_;
  Linearization first_, second_;
  Linearization *here_ = &first_, *there_ = &second_;  ///< of current_ and trial_
  Correction correction_, simplified_;
  State current_, trial_;
  Target target_;
  double jacobian_error_ = 0;
  bool simplified_at_hand_ = false;  ///< simplified_ is the step from here_ with the factored Jacobian
};

}  // namespace genu
