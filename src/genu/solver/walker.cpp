#include "genu/solver/walker.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace genu {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

bool contains(const State& state, const ActiveContact& contact) {
  return std::any_of(state.contacts.begin(), state.contacts.end(),
                     [&](const ActiveContact& c) { return c.pair == contact.pair && c.number == contact.number; });
}

}  // namespace

void Walker::begin(const StepPlan& plan, int step, Balanced pose, PoseReport report) {
  plan_ = plan;
  step_ = step;
  stiffest_seen_ = 0;
  accept(0, std::move(pose), report);
}

void Walker::emit(PathEvent::Kind kind, const std::string& what) { event_({kind, step_, t_, plan_.target(t_), what}); }

void Walker::compute_tangent() {
  const JointModel& model = solver_.model();
  const Target target = plan_.target(t_), rate = plan_.rate();
  linearize(model, pose_.state, target, here_);
  stability_ = assess_stability(here_, model.scales.length);
  stiffest_seen_ = std::max(stiffest_seen_, std::abs(stability_.smallest));
  NewtonStep& step = solver_.newton().step();
  if (!step.factor(here_, target)) {
    tangent_.resize(0, 0, 0);
    return;
  }
  VecX constraint_rate(static_cast<Eigen::Index>(rate.prescribed.size()));
  for (std::size_t m = 0; m < rate.prescribed.size(); ++m)
    constraint_rate[static_cast<Eigen::Index>(m)] = -rate.prescribed[m].value;
  step.solve_rates(load_wrench(model, pose_.state, rate.load_factors), constraint_rate, tangent_);
}

void Walker::accept(double t, Balanced pose, const PoseReport& report) {
  const auto before = stability_.verdict;
  const bool first = substeps_ == 0;
  t_ = t;
  pose_ = std::move(pose);
  report_ = report;
  ++substeps_;
  compute_tangent();
  if (!first && stability_.verdict != before) emit(PathEvent::Kind::stability_changed, to_string(stability_.verdict));
}

Walker::Attempt Walker::attempt(double t) {
  Attempt out;
  out.pose = pose_;
  const bool predictable = tangent_.twist.size() > 0 && tangent_.twist.allFinite();
  if (predictable) {
    State predicted;
    if (retract(solver_.model(), pose_.state, tangent_, t - t_, predicted)) out.pose.state = std::move(predicted);
  }
  out.report = solver_.solve_held(out.pose, plan_.target(t), out.findings);
  iterations_ += out.report.iterations;
  return out;
}

double Walker::distance(const State& from, const State& to) const {
  const double L = solver_.model().scales.length;
  double sum = 0;
  for (std::size_t i = 0; i < from.poses.size(); ++i)
    sum +=
        (to.poses[i].p - from.poses[i].p).norm() / L + log_rotation(to.poses[i].R * from.poses[i].R.transpose()).norm();
  return sum;
}

double Walker::speed() const {
  const double L = solver_.model().scales.length;
  double sum = 0;
  for (Eigen::Index i = 0; i < tangent_.twist.size(); i += 6)
    sum += tangent_.twist.segment<3>(i).norm() / L + tangent_.twist.segment<3>(i + 3).norm();
  return sum;
}

bool Walker::jumped(const State& state, double h) const {
  // A pose that lies much farther than the tangent leads has left the branch that is followed.
  constexpr double kFactor = 4, kSlack = 0.02;
  return distance(pose_.state, state) > kFactor * h * speed() + kSlack;
}

bool Walker::walk_to(double t_end) {
  double h = t_end - t_;
  while (t_ < t_end) {
    // Toward a limit point the tangent grows without bound: a step may move the bodies so far and no farther, or the
    // solution found at its end may lie on another branch.
    constexpr double kFarthest = 0.25;  // characteristic lengths, rad
    h = std::min(h, kFarthest / std::max(speed(), 1e-300));
    if (h < options_.smallest_increment) {
      failure_ = {};
      failure_.why = "the path becomes infinitely steep";
      return false;
    }
    const double t = std::min(t_end, t_ + h);
    Attempt trial = attempt(t);
    const bool solved = trial.report.newton.converged();
    if (solved && trial.valid() && !jumped(trial.pose.state, t - t_)) {
      solver_.follow_open(trial.pose);
      accept(t, std::move(trial.pose), trial.report);
      h *= 2;
      continue;
    }
    if (solved && !trial.findings.none() && !jumped(trial.pose.state, t - t_)) {
      if (!pass_event(t, std::move(trial))) return false;
      h = std::max(h, (t_end - t_) / 4);
      continue;
    }
    failure_ = trial.report;
    h = (t - t_) / 2;
    if (h < options_.smallest_increment) return false;
  }
  return true;
}

bool Walker::pass_event(double t, Attempt violated) {
  // Regula falsi (Illinois) on the worst force or gap, bisection where that has no two finite values to work with.
  double low_value = std::numeric_limits<double>::infinity(), high_value = violated.findings.worst;
  double weight_low = 1, weight_high = 1;
  for (int i = 0; i < 100 && t - t_ > options_.event_tolerance; ++i) {
    double middle = 0.5 * (t_ + t);
    if (std::isfinite(low_value) && high_value < 0 && low_value > 0 && i % 3 != 2) {
      const double low = weight_low * low_value, high = weight_high * high_value;
      middle = t_ + (t - t_) * std::clamp(low / (low - high), 0.02, 0.98);
    }
    Attempt trial = attempt(middle);
    if (trial.report.newton.converged() && trial.valid()) {
      low_value = trial.findings.worst;
      weight_low = 1;
      weight_high *= 0.5;
      solver_.follow_open(trial.pose);
      accept(middle, std::move(trial.pose), trial.report);
    } else if (trial.report.newton.converged() && !trial.findings.none()) {
      t = middle;
      high_value = trial.findings.worst;
      weight_high = 1;
      weight_low *= 0.5;
      violated = std::move(trial);
    } else {
      failure_ = trial.report;
      t = middle;
      high_value = 0;
    }
  }
  Balanced next = violated.pose;
  if (violated.findings.over_edge || violated.findings.deep_overlap) {
    failure_ = violated.report;
    emit(violated.findings.over_edge ? PathEvent::Kind::over_edge : PathEvent::Kind::overlap, violated.findings.where);
    return false;
  }
  PoseReport report = solver_.settle(next, plan_.target(t));
  iterations_ += report.iterations;
  if (report.status != PoseStatus::ok) {
    next = pose_;
    report = solver_.settle_from_seed(next, plan_.target(t));
    iterations_ += report.iterations;
  }
  if (report.status != PoseStatus::ok) {
    failure_ = report;
    return false;
  }
  const Balanced before = pose_;
  accept(t, std::move(next), report);
  report_changes(before, pose_);
  return true;
}

void Walker::report_changes(const Balanced& before, const Balanced& after) {
  const auto name = [&](const ActiveContact& c) {
    return fmt::format("{}.{}", solver_.model().pairs[at(c.pair)].name, c.number);
  };
  for (const ActiveContact& c : after.state.contacts)
    if (!contains(before.state, c)) emit(PathEvent::Kind::contact_gained, name(c));
  for (const ActiveContact& c : before.state.contacts)
    if (!contains(after.state, c)) emit(PathEvent::Kind::contact_lost, name(c));
}

bool Walker::balance_at(double t, Balanced& next, PoseReport& report) {
  for (const bool seeded : {false, true}) {
    next = pose_;
    report = seeded ? solver_.settle_from_seed(next, plan_.target(t)) : solver_.settle(next, plan_.target(t));
    iterations_ += report.iterations;
    if (report.status != PoseStatus::ok) continue;
    if (!jumped(next.state, t - t_)) return true;
    const Pose &from = pose_.state.poses.back(), &to = next.state.poses.back();
    snap_ = {(to.p - from.p).norm(), log_rotation(to.R * from.R.transpose()).norm()};
  }
  return false;
}

bool Walker::step_over(double window) {
  const double from = t_;
  snap_ = {0, 0};
  // Where a contact splits, its two halves can be told apart a millionth of a degree later: begin that near.
  for (const double fraction : {1e-5, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0}) {
    const double t = std::min(1.0, from + fraction * window);
    Balanced next;
    PoseReport report;
    if (balance_at(t, next, report)) {
      const Balanced before = pose_;
      emit(PathEvent::Kind::stepped_over, "from here");
      accept(t, std::move(next), report);
      emit(PathEvent::Kind::stepped_over, "to here");
      report_changes(before, pose_);
      return true;
    }
    if (t == 1.0) break;
  }
  return false;
}

bool Walker::turning_back() const {
  // Toward a limit point the smallest eigenvalue goes to 0 as the square root of the distance; the path was followed
  // until that distance was the smallest increment.
  constexpr double kVanishing = 0.02;
  return std::isfinite(stability_.smallest) && std::abs(stability_.smallest) < kVanishing * stiffest_seen_;
}

}  // namespace genu
