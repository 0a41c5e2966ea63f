#include "genu/solver/newton.h"

#include <algorithm>
#include <cmath>

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

/// Of the step that the Jacobian at hand would take from there.
double Newton::simplified_norm(const Target& target) {
  step_.solve(there_, simplified_);
  return step_.norm(simplified_, target);
}

bool Newton::advance(const Target& target, const NewtonOptions& options, double residual, NewtonReport& report) {
  const double full = step_.norm(correction_, target);
  report.outcome = NewtonReport::Outcome::no_descent;
  for (double damping = admissible_fraction(correction_, options); damping >= options.smallest_damping; damping /= 2) {
    if (!retract(*model_, current_, correction_, damping, trial_)) {
      report.outcome = NewtonReport::Outcome::left_the_surface;
      continue;
    }
    linearize(*model_, trial_, target, there_);
    if (asked_to_stop(options.cancelled)) return false;
    const double next = step_.residual(there_, target);
    if (!std::isfinite(next)) continue;
    // So small already that only rounding is left to compare, or monotone in the natural level function.
    if (next <= options.residual_tolerance || (next <= options.residual_floor && next <= residual) ||
        simplified_norm(target) <= (1 - damping / 4) * full) {
      std::swap(current_, trial_);
      std::swap(here_, there_);
      return true;
    }
    report.outcome = NewtonReport::Outcome::no_descent;
  }
  return false;
}

NewtonReport Newton::solve(State& state, const Target& target, const NewtonOptions& options) {
  NewtonReport report;
  stop_layers_when(options.cancelled, here_);
  there_.layers = here_.layers;
  finer_ = state;
  do {
    report.outcome = NewtonReport::Outcome::not_finite;
    solve_as_fine(finer_, target, options, report);
  } while (report.converged() && raise_layer_levels(*model_, here_, finer_));
  if (report.converged()) std::swap(state, finer_);
  if (!report.converged() && asked_to_stop(options.cancelled)) report.outcome = NewtonReport::Outcome::cancelled;
  return report;
}

/// With the layers as they are; counts iterations on.
void Newton::solve_as_fine(State& state, const Target& target, const NewtonOptions& options, NewtonReport& report) {
  if (asked_to_stop(options.cancelled)) return;
  current_ = state;
  fit_multipliers(*model_, target, current_);
  linearize(*model_, current_, target, here_);
  double residual = step_.residual(here_, target), last = 0;
  bool same_again = false;
  const auto factor = [&] {
    if (!step_.factor(here_, target, options.route)) return false;
    report.rcond = step_.linear().rcond();
    report.full_rank = step_.linear().full_rank();
    report.minimum_norm = step_.linear().minimum_norm();
    return true;
  };
  for (;; ++report.iterations) {
    if (asked_to_stop(options.cancelled)) return;
    report.remember(residual, same_again);
    if (!std::isfinite(residual)) return;
    const bool solved = residual <= options.residual_tolerance;
    // With the Jacobian that took it from `last` to here the residual falls about as much again, but for a factor of 2.
    same_again = !solved && 2 * residual * residual <= options.residual_tolerance * last;
    if (!same_again && !factor()) return;
    if (solved) break;
    if (report.iterations == options.max_iterations) {
      report.outcome = NewtonReport::Outcome::iterations_used_up;
      return;
    }
    step_.solve(here_, correction_);
    bool moved = advance(target, options, residual, report);
    if (!moved && same_again) {
      same_again = false;
      if (!factor()) return;
      step_.solve(here_, correction_);
      moved = advance(target, options, residual, report);
    }
    if (!moved) {
      if (residual > options.residual_floor) return;
      break;
    }
    const double next = step_.residual(here_, target);
    // Rounding ends the fall: below the floor a step that no longer halves the residual is the last one.
    if (next > 0.5 * residual && next <= options.residual_floor) {
      report.residual = next;
      ++report.iterations;
      if (!factor()) return;
      break;
    }
    last = residual;
    residual = next;
  }
  report.outcome = NewtonReport::Outcome::converged;
  state = current_;
}

}  // namespace genu
