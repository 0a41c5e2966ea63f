#include "genu/equilibrium/newton.h"

#include <algorithm>
#include <cmath>

#include "genu/equilibrium/tolerances.h"
#include "genu/model/layer_levels.h"

namespace genu {

std::string to_string(NewtonReport::Outcome outcome) {
  switch (outcome) {
    case NewtonReport::Outcome::converged:
      return "converged";
    case NewtonReport::Outcome::iterations_used_up:
      return "no convergence within the iterations allowed";
    case NewtonReport::Outcome::no_descent:
      return "no step reduces the error";
    case NewtonReport::Outcome::left_the_surface:
      return "a contact point leaves its surface";
    case NewtonReport::Outcome::not_finite:
      return "the equations are not finite";
    case NewtonReport::Outcome::cancelled:
      return "cancelled";
  }
  return "";
}

void NewtonReport::remember(double next, bool simplified) {
  for (int i = 0; i < 2; ++i) {
    residual_history[i] = residual_history[i + 1];
    simplified_history[i] = simplified_history[i + 1];
  }
  residual_history[2] = residual = next;
  simplified_history[2] = simplified;
}

double Newton::admissible_fraction(const Correction& correction, const NewtonOptions& options) const {
  double excess = 1;
  const double size = model_->scales.size;
  for (Eigen::Index i = 0; i < correction.twist.size(); i += 6) {
    excess = std::max(excess, correction.twist.segment<3>(i).norm() / (options.max_translation * size));
    excess = std::max(excess, correction.twist.segment<3>(i + 3).norm() / options.max_rotation);
  }
  for (const Vec4& ds : correction.surface)
    excess = std::max(
        {excess, ds.head<2>().norm() / (options.max_slide * size), ds.tail<2>().norm() / (options.max_slide * size)});
  return 1 / excess;
}

/// Norm of the simplified Newton correction: the step from there with the factored Jacobian.
double Newton::simplified_norm() {
  step_.solve(*there_, simplified_);
  simplified_at_hand_ = true;
  return step_.norm(simplified_);
}

/// Evaluates the derivatives at current_ if they are missing.
void Newton::complete() {
  if (!here_->derivatives) linearize(*model_, current_, target_, *here_);
}

const Linearization& Newton::linearization() {
  complete();
  return *here_;
}

bool Newton::factor_at_solution(NewtonStep::Route route) {
  if (jacobian_error_ == 0) return true;
  complete();
  jacobian_error_ = 0;
  return step_.factor(*here_, target_, route);
}

bool Newton::factor(const NewtonOptions& options, NewtonReport& report) {
  complete();
  if (!step_.factor(*here_, target_, options.route)) return false;
  report.rcond = step_.linear().rcond();
  report.full_rank = step_.linear().full_rank();
  report.minimum_norm = step_.linear().minimum_norm();
  jacobian_error_ = 0;
  return true;
}

/// One damped step. `residual` becomes the residual at its end.
bool Newton::advance(const NewtonOptions& options, double& residual, NewtonReport& report) {
  // This close to the solution the next step may reuse the factored Jacobian.
  const Derivatives wanted = residual <= kJacobianReuse ? Derivatives::none : Derivatives::all;
  const double full = step_.norm(correction_);
  report.outcome = NewtonReport::Outcome::no_descent;
  for (double damping = admissible_fraction(correction_, options); damping >= options.smallest_damping; damping /= 2) {
    if (!retract(*model_, current_, correction_, damping, trial_)) {
      report.outcome = NewtonReport::Outcome::left_the_surface;
      continue;
    }
    linearize(*model_, trial_, target_, *there_, wanted);
    simplified_at_hand_ = false;
    if (asked_to_stop(options.cancelled)) return false;
    const double next = step_.residual(*there_, target_);
    if (!std::isfinite(next)) continue;
    // Accept: converged, below the floor where rounding dominates, or monotone in the natural level function.
    if (next <= options.residual_tolerance || (next <= options.residual_floor && next <= residual) ||
        simplified_norm() <= (1 - damping / 4) * full) {
      std::swap(current_, trial_);
      std::swap(here_, there_);
      residual = next;
      return true;
    }
    report.outcome = NewtonReport::Outcome::no_descent;
  }
  return false;
}

NewtonReport Newton::solve(State& state, const Target& target, const NewtonOptions& options) {
  NewtonReport report;
  stop_layers_when(options.cancelled, *here_);
  there_->layers = here_->layers;
  current_ = state;
  target_ = target;
  do {
    report.outcome = NewtonReport::Outcome::not_finite;
    solve_as_fine(options, report);
  } while (report.converged() && raise_layer_levels(*model_, *here_, current_));
  if (report.converged()) state = current_;
  if (!report.converged() && asked_to_stop(options.cancelled)) report.outcome = NewtonReport::Outcome::cancelled;
  return report;
}

/// From current_, with the layers as they are; counts iterations on. The last Jacobian is that at the solution, or one
/// that differs from it by at most kTrustedFall of itself: the residual fell by that in the first step taken with it.
void Newton::solve_as_fine(const NewtonOptions& options, NewtonReport& report) {
  if (asked_to_stop(options.cancelled)) return;
  fit_multipliers(*model_, target_, current_);
  linearize(*model_, current_, target_, *here_);
  double residual = step_.residual(*here_, target_), fall = 1;
  bool same_again = false;
  for (;; ++report.iterations) {
    if (asked_to_stop(options.cancelled)) return;
    report.remember(residual, same_again);
    if (!std::isfinite(residual)) return;
    const bool solved = residual <= options.residual_tolerance;
    // Each step with the same Jacobian reduces the residual about as much as the first one, up to a factor of 2. Two of
    // them cost less than one with a new Jacobian.
    const double again = 2 * fall;
    same_again = !solved && again <= kSteepFall && residual * again * again <= options.residual_tolerance;
    const bool trusted = fall <= kTrustedFall && model_->layers.empty();
    if (solved && trusted) break;
    if (!same_again && !factor(options, report)) return;
    if (solved) break;
    if (report.iterations == options.max_iterations) {
      report.outcome = NewtonReport::Outcome::iterations_used_up;
      return;
    }
    if (same_again && simplified_at_hand_)
      std::swap(correction_, simplified_);
    else
      step_.solve(*here_, correction_);
    double next = residual;
    bool moved = advance(options, next, report);
    if (!moved && same_again) {
      same_again = false;
      if (!factor(options, report)) return;
      step_.solve(*here_, correction_);
      moved = advance(options, next, report);
    }
    if (!moved) {
      if (residual > options.residual_floor) return;
      break;
    }
    // Rounding ends convergence: below the floor, a step that does not halve the residual is the last one.
    if (!same_again && next > 0.5 * residual && next <= options.residual_floor) {
      report.residual = next;
      ++report.iterations;
      if (!factor(options, report)) return;
      break;
    }
    // A step with the same Jacobian that reduces it less than was expected says that the first one was lucky.
    if (!same_again || next > again * residual) fall = jacobian_error_ = next / residual;
    residual = next;
  }
  if (residual <= options.residual_tolerance) polish(options, report);
  report.outcome = NewtonReport::Outcome::converged;
}

/// With an ill-conditioned Jacobian a small residual does not imply a small error: beside a ligament of 1e9 N/mm a load
/// of 1 mN passes for balanced, however soft the part that carries it. The next correction measures the error.
void Newton::polish(const NewtonOptions& options, NewtonReport& report) {
  const double error = std::max(kMinPolishError, kPolishOfTolerance * options.residual_tolerance);
  for (; report.iterations < options.max_iterations; ++report.iterations) {
    const double residual = report.residual;
    if (residual <= kResidualRounding || residual <= error * report.rcond) return;
    step_.solve(*here_, correction_);
    if (!(step_.norm(correction_) > error)) return;
    const double damping = admissible_fraction(correction_, options);
    if (!retract(*model_, current_, correction_, damping, trial_)) return;
    linearize(*model_, trial_, target_, *there_);
    if (asked_to_stop(options.cancelled)) return;
    const double next = step_.residual(*there_, target_);
    const bool better =
        next <= (1 - kMinPolishFall * damping) * residual && step_.factor(*there_, target_, options.route);
    if (better) {
      std::swap(current_, trial_);
      std::swap(here_, there_);
      report.remember(next, false);
    } else {
      complete();
      // Of the matrix that was factored before the trial: what it fails at, rcond shows.
      static_cast<void>(step_.factor(*here_, target_, options.route));
    }
    jacobian_error_ = 0;
    report.rcond = step_.linear().rcond();
    if (!better) return;
  }
}

}  // namespace genu
