#include "genu/path/arc_newton.h"

#include <algorithm>
#include <cmath>

#include "genu/model/layer_levels.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

void scale(double factor, Correction& c) {
  c.twist *= factor;
  c.multipliers *= factor;
  c.forces *= factor;
  for (Vec4& ds : c.surface) ds *= factor;
  c.parameter *= factor;
}

}  // namespace

ArcNewton::ArcNewton(const JointModel& model, const NewtonOptions& options)
    : model_(&model), options_(options), step_(model) {
  stop_layers_when(options.cancelled, here_);
}

double ArcNewton::product(const Correction& a, const Correction& b) const {
  const double L = model_->scales.length;
  double sum = a.parameter * b.parameter;
  for (Eigen::Index i = 0; i < a.twist.size(); i += 6)
    sum += a.twist.segment<3>(i).dot(b.twist.segment<3>(i)) / (L * L) +
           a.twist.segment<3>(i + 3).dot(b.twist.segment<3>(i + 3));
  return sum;
}

void ArcNewton::linearize_at(const StepPlan& plan, const State& state, double t) {
  linearize(*model_, state, plan.target(t), here_);
}

bool ArcNewton::factor(const StepPlan& plan, const State& state, double t, const Correction& along) {
  const double L = model_->scales.length;
  const Target target = plan.target(t), rate = plan.rate();
  border_.wrench_rate = load_rate(*model_, state, target, rate);
  border_.constraint_rate = constraint_rate(rate, here_.constraint.size());
  border_.twist = along.twist;
  for (Eigen::Index i = 0; i < border_.twist.size(); i += 6) border_.twist.segment<3>(i) /= L * L;
  border_.parameter = along.parameter;
  return step_.factor(here_, target, options_.route, &border_);
}

bool ArcNewton::direction(const StepPlan& plan, const State& state, double t, const Correction& along,
                          Correction& out) {
  linearize_at(plan, state, t);
  if (asked_to_stop(options_.cancelled)) return false;
  if (!factor(plan, state, t, along) || !step_.linear().full_rank()) return false;
  step_.solve_direction(out);
  const double norm = std::sqrt(product(out, out));
  if (!std::isfinite(norm) || !(norm > 0)) return false;
  scale(1 / norm, out);
  return true;
}

void ArcNewton::reverse(Correction& direction) { scale(-1, direction); }

bool ArcNewton::forward(const StepPlan& plan, const State& state, double t, Correction& out) {
  Correction along;
  along.resize(model_->moving_count, 0, 0);
  along.twist.setZero();
  along.parameter = 1;
  return direction(plan, state, t, along, out);
}

bool ArcNewton::correct(const StepPlan& plan, const Correction& along, ArcPoint& point, NewtonReport& report) {
  double last = kMaxArcCorrection;
  strayed_ = 0;
  for (report.iterations = 0;; ++report.iterations) {
    linearize_at(plan, point.pose.state, point.t);
    if (asked_to_stop(options_.cancelled)) {
      report.outcome = NewtonReport::Outcome::cancelled;
      return false;
    }
    const double before = report.residual;
    report.residual = step_.residual(here_, plan.target(point.t));
    report.remember(report.residual, false);
    if (!std::isfinite(report.residual)) return false;
    const bool stalled = report.iterations > 1 && report.residual > 0.5 * before;
    const bool solved =
        report.residual <= options_.residual_tolerance || (stalled && report.residual <= options_.residual_floor);
    if (!factor(plan, point.pose.state, point.t, along)) return false;
    report.rcond = step_.linear().rcond();
    report.full_rank = step_.linear().full_rank();
    report.minimum_norm = step_.linear().minimum_norm();
    if (solved) {
      if (!raise_layer_levels(*model_, here_, point.pose.state)) return true;
      continue;
    }
    report.outcome = NewtonReport::Outcome::iterations_used_up;
    if (report.iterations == kMaxArcIterations) return false;
    step_.solve(here_, correction_);
    const double size = std::sqrt(product(correction_, correction_));
    report.outcome = NewtonReport::Outcome::no_descent;
    if (!(size <= 2 * last)) return false;
    last = std::max(size, 1e-9);
    strayed_ += size;
    report.outcome = NewtonReport::Outcome::left_the_surface;
    if (!retract(*model_, point.pose.state, correction_, 1, trial_)) return false;
    std::swap(point.pose.state, trial_);
    point.t += correction_.parameter;
  }
}

NewtonReport ArcNewton::solve(const StepPlan& plan, const ArcPoint& from, double arc, ArcPoint& out) {
  NewtonReport report;
  report.outcome = NewtonReport::Outcome::cancelled;
  if (asked_to_stop(options_.cancelled)) return report;
  if (!retract(*model_, from.pose.state, from.direction, arc, out.pose.state)) {
    report.outcome = NewtonReport::Outcome::left_the_surface;
    return report;
  }
  out.t = from.t + arc * from.direction.parameter;
  report.outcome = NewtonReport::Outcome::not_finite;
  if (!correct(plan, from.direction, out, report)) return report;
  directed_ = direction(plan, out.pose.state, out.t, from.direction, out.direction);
  if (!directed_) out.direction = from.direction;
  report.outcome = NewtonReport::Outcome::converged;
  return report;
}

}  // namespace genu
