#include "genu/path/path_follower.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "genu/core/bracket.h"
#include "genu/equilibrium/piece_changes.h"
#include "genu/equilibrium/state_difference.h"
#include "genu/equilibrium/uniqueness.h"
#include "genu/path/tolerances.h"

namespace genu {

void PathFollower::begin(const StepPlan& plan, int step, Balanced pose, const PoseReport& report) {
  plan_ = plan;
  rate_ = plan.rate();
  step_ = step;
  driven_ = plan.only_driven();
  t_ = 0;
  stiffest_seen_ = 0;
  last_definite_ = 0;
  stepped_over_ = crowd_ = 0;
  crowd_from_ = 0;
  tangent_.motion.resize(0, 0, 0);  // belongs to the loads of the step before
  prediction_.forget();
  accept(0, std::move(pose), report);
}

void PathFollower::compute_tangent(const State& state, double t, Tangent& out) {
  if (here_.layers == nullptr) here_.layers = solver_.newton().layers();
  linearize(solver_.model(), state, plan_.target(t), here_);
  if (solver_.newton().step().factor(here_, plan_.target(t))) return compute_tangent(here_, state, t, out);
  out.motion.resize(0, 0, 0);
  out.stability = assess_stability(here_, solver_.model().scales.length);
}

void PathFollower::compute_tangent(const Linearization& at, const State& state, double t, Tangent& out) {
  const JointModel& model = solver_.model();
  out.stability = assess_stability(at, model.scales.length);
  solver_.newton().step().solve_rates(load_rate(model, state, plan_.target(t), rate_),
                                      constraint_rate(rate_, at.constraint.size()), out.motion);
}

void PathFollower::compute_tangent_of_last(const State& state, double t, Tangent& out) {
  // Factor on the relative error of the Jacobian, of all rates together. A smaller rate of the reaction has a reliable
  // sign only with the Jacobian at the solution.
  Newton& newton = solver_.newton();
  compute_tangent(newton.linearization(), state, t, out);
  if (driven_ < 0 || newton.jacobian_error() == 0) return;
  const Target target = plan_.target(t);
  const bool rotation = is_rotation(solver_.model(), target, at(driven_));
  const auto& scales = solver_.model().scales;
  const double rate = std::abs(reaction_rate(out)) / (rotation ? scales.force * scales.length : scales.force);
  if (rate > kRateMargin * newton.jacobian_error() * newton.step().norm(out.motion)) return;
  if (newton.factor_at_solution()) compute_tangent(newton.linearization(), state, t, out);
}

void PathFollower::accept(double t, Balanced pose, const PoseReport& report, bool leaps) {
  compute_tangent(pose.state, t, next_);
  const bool first = substeps_ == 0;
  for (const Turn& turn : law_turns(t, pose.state, leaps)) emit_at(turn.kind, turn.t, turn.state, turn.what);
  take(t, std::move(pose), report);
  if (stability().complex_pair && (first || !next_.stability.complex_pair))
    emit(PathEvent::Kind::flutter, "complex pair of stiffness eigenvalues");
  if (first) return;
  // Contacts may have changed here, and with them the rates.
  if (stability().verdict != next_.stability.verdict)
    emit(PathEvent::Kind::stability_changed, to_string(stability().verdict));
  if (leaps || !opposite(reaction_rate(next_), reaction_rate(tangent_))) return;
  if (const std::string words = reaction_words(tangent_, pose_.state); !words.empty())
    emit(PathEvent::Kind::reaction_turns, words);
}

bool PathFollower::pass(double t, Attempt trial) {
  std::vector<Turn> turns;
  if (!find_turns(t, trial.pose.state, turns)) return false;
  for (const Turn& turn : turns) emit_at(turn.kind, turn.t, turn.state, turn.what);
  solver_.follow_open(trial.pose);
  take(t, std::move(trial.pose), trial.report);
  return true;
}

void PathFollower::take(double t, Balanced pose, const PoseReport& report) {
  if (t > t_ && same_contacts(pose_.state, pose.state))
    prediction_.went_on(t - t_, tangent_.motion, next_.motion);
  else
    prediction_.forget();
  t_ = t;
  inside_ = std::numeric_limits<double>::infinity();
  pose_ = std::move(pose);
  report_ = report;
  std::swap(tangent_, next_);
  ++substeps_;
  if (stability().verdict != Stability::Verdict::neutral) last_definite_ = stability().smallest;
  stiffest_seen_ = std::max(stiffest_seen_, std::abs(stability().smallest));
}

PathFollower::Attempt PathFollower::attempt(double t, bool locating) {
  Attempt out;
  out.pose = pose_;
  const bool predictable = tangent_.motion.twist.size() > 0 && tangent_.motion.twist.allFinite();
  if (predictable && prediction_.at(pose_.state, tangent_.motion, t - t_, out.predicted))
    out.pose.state = out.predicted;
  else
    out.predicted = pose_.state;
  out.report = solver_.solve_held(out.pose, plan_.target(t), out.findings, locating);
  iterations_ += out.report.iterations;
  return out;
}

bool PathFollower::passes_a_fold(const Tangent& next, const State& there, double h) const {
  // Beyond a limit point, on another branch, the bodies soon move as slowly as before it. A step across which the speed
  // changes by more than kRatio is halved; a very short one is accepted, because a nonsmooth point of a law changes the
  // speed too. Past two neighbouring limit points both prediction and speed may agree by chance. With this ratio one of
  // the two tests fails there if the path is a cubic.
  const double before = speed(solver_.model(), pose_.state, tangent_.motion.twist);
  const double after = speed(solver_.model(), there, next.motion.twist);
  if (h <= kShortestSpeedStep || h * std::max(before, after) <= kStillMotion) return false;
  return std::max(before, after) > kSpeedRatio * std::min(before, after);
}

bool PathFollower::far_from_predicted(const Attempt& attempt) const {
  // On one branch the error of the tangent is of second order in the step. A step whose error exceeds half of it is
  // halved.
  return distance(solver_.model(), attempt.predicted, attempt.pose.state) >
         kPredictionShare * distance(solver_.model(), pose_.state, attempt.predicted) + kPredictionSlack;
}

bool PathFollower::jumped(const State& state, double h) const {
  // A pose much farther away than the tangent predicts lies on another branch.
  return distance(solver_.model(), pose_.state, state) >
         std::min(kMotionFactor * h * speed(solver_.model(), pose_.state, tangent_.motion.twist), kLongestMotion) +
             kMotionSlack;
}

bool PathFollower::passes_through(const Attempt& trial) {
  return solver_.passes_through(pose_.state, trial.pose.state, true);
}

bool PathFollower::advance_to(double t_end) {
  snap_ = {0, 0};
  no_rest_ = {};
  law_jump_.clear();
  double h = t_end - t_;
  while (t_ < t_end) {
    const double fastest = speed(solver_.model(), pose_.state, tangent_.motion.twist);
    h = std::min({h, kLongestSubstep, kLongestMotion / std::max(fastest, 1e-300)});
    if (h < options_.smallest_increment) {
      failure_ = {};
      failure_.why = "the path becomes infinitely steep";
      return says_what_slips();
    }
    const double t = t_ + h * (1 + kRestShare) < t_end ? t_ + h : t_end;
    Attempt trial = attempt(t);
    const bool solved = trial.report.newton.converged();
    const bool followed = solved && !far_from_predicted(trial) && !passes_through(trial);
    if (followed && trial.valid()) {
      compute_tangent_of_last(trial.pose.state, t, next_);
      if (!passes_a_fold(next_, trial.pose.state, t - t_)) {
        const double inside = trial.findings.worst;
        if (pass(t, trial)) {
          inside_ = inside;
          h *= 2;
          continue;
        }
      }
    }
    if (followed && !trial.findings.none()) {
      if (!pass_event(t, std::move(trial)) || events_without_end()) return false;
      h = std::max(h, (t_end - t_) / 4);
      continue;
    }
    failure_ = trial.report;
    if (solved && failure_.why.empty()) failure_.why = "the solution found lies on another branch, or through a body";
    h = (t - t_) / 2;
    if (h < options_.smallest_increment) return says_what_slips();
  }
  return true;
}

bool PathFollower::says_what_slips() {
  const std::string path = path_about_to_slip(solver_.model(), pose_.state);
  if (path.empty()) return false;
  failure_.status = PoseStatus::slips_off;
  failure_.why = path + " is no shortest way any more: it slips off";
  emit(PathEvent::Kind::slips_off, path);
  return false;
}

bool PathFollower::events_without_end() {
  // Contacts that change faster and faster do not converge, however many changes are followed.
  if (t_ - crowd_from_ > kCrowdedStep || t_ < crowd_from_) crowd_from_ = t_, crowd_ = 0;
  if (++crowd_ <= kMaxCrowdedChanges) return false;
  failure_ = {};
  failure_.status = PoseStatus::chatter;
  failure_.why = "contacts open and close without end";
  return true;
}

bool PathFollower::pass_event(double t, Attempt violated) {
  constexpr double kNoSide = std::numeric_limits<double>::infinity();
  const double began = t_, asked = t;
  Bracket bracket(t_, inside_, t, violated.findings.worst, options_.event_tolerance);
  std::pair<double, double> sides = sides_of_change(t, violated);
  for (int looks = 0; bracket.open(); ++looks) {
    // A single ligament at a break: its length is smooth there, and the secant gives the distance past the break.
    const double worst_there = violated.findings.worst;
    if (t == bracket.high() && violated.findings.only_left_piece() && std::isfinite(inside_) && inside_ > 0 &&
        -worst_there * bracket.width() <= options_.event_tolerance * (inside_ - worst_there)) {
      // No contact has been searched for yet there: one may have changed before.
      const NewtonReport newton = violated.report.newton;
      violated.report = solver_.inspect(violated.pose.state, newton, violated.findings);
      if (violated.findings.only_left_piece()) break;
      sides = sides_of_change(t, violated);
    }
    const bool before = !std::isnan(sides.first);
    const double known = std::exchange(before ? sides.first : sides.second, std::numeric_limits<double>::quiet_NaN());
    const double middle = known >= bracket.low() && known <= bracket.high() ? known : bracket.next();
    Attempt trial = attempt(middle, true);
    const double worst = trial.findings.worst;
    if (goes_on_to(middle, trial)) {
      bracket.move_low(middle, worst);
      inside_ = worst;
    } else if (trial.report.newton.converged() && !trial.findings.none()) {
      bracket.move_high(middle, worst);
      t = middle;
      violated = std::move(trial);
      // Something else has changed before.
      if (before && looks < kMaxOtherChanges) sides = sides_of_change(t, violated);
    } else {
      bracket.move_high(middle, kNoSide);
      failure_ = trial.report;
    }
  }
  if (t == asked && !bracket.open() && t_ > began) {
    // Solved from far away, it may lie on another branch: once more from beside it.
    Attempt trial = attempt(t, true);
    if (goes_on_to(t, trial)) return true;
    if (trial.report.newton.converged() && !trial.findings.none()) violated = std::move(trial);
  }
  t = bracket.high();
  Balanced next = violated.pose;
  if (violated.findings.final()) {
    failure_ = violated.report;
    emit(end_of(violated.findings), violated.findings.where);
    return false;
  }
  PoseReport report;
  if (const std::string drop = dropped_force(solver_.model(), violated.findings, violated.pose.state); !drop.empty()) {
    report = fall(t, drop, next);
    if (report.status != PoseStatus::ok || distance(solver_.model(), violated.pose.state, next.state) > kFallMotion)
      emit_at(PathEvent::Kind::jump, t, violated.pose.state, drop);
  } else {
    report = settle_beyond(t, next);
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

PoseReport PathFollower::settle_beyond(double t, Balanced& next) {
  PoseReport report = solver_.settle(next, plan_.target(t));
  iterations_ += report.iterations;
  if (report.status != PoseStatus::ok) {
    next = pose_;
    report = solver_.settle_from_seed(next, plan_.target(t));
    iterations_ += report.iterations;
  }
  if (report.status == PoseStatus::ok && jumped(next.state, t - t_)) {
    snap_ = largest_motion(pose_.state, next.state);
    report.status = PoseStatus::no_equilibrium;
    report.why = "the equilibrium path ends where its contacts change";
  }
  return report;
}

PoseReport PathFollower::fall(double t, const std::string& drop, Balanced& next) {
  // Prescribed coordinates are constant while the joint moves downhill, to a near equilibrium and not to any.
  const Balanced edge = next;
  PoseReport report;
  for (const bool seeded : {false, true}) {
    next = edge;
    report = seeded ? solver_.settle_from_seed(next, plan_.target(t), true) : solver_.settle(next, plan_.target(t));
    iterations_ += report.iterations;
    if (report.status != PoseStatus::ok) continue;
    if (distance(solver_.model(), edge.state, next.state) <= kLongestMotion) return report;
    snap_ = largest_motion(pose_.state, next.state);
    report.status = PoseStatus::no_equilibrium;
  }
  law_jump_ = drop;
  report.why = "no equilibrium is near beyond the jump of ligament " + drop;
  return report;
}

bool PathFollower::balance_at(double t, Balanced& next, PoseReport& report) {
  for (const bool seeded : {false, true}) {
    next = pose_;
    report = seeded ? solver_.settle_from_seed(next, plan_.target(t)) : solver_.settle(next, plan_.target(t));
    iterations_ += report.iterations;
    if (report.status != PoseStatus::ok) continue;
    if (!jumped(next.state, t - t_)) return true;
    snap_ = largest_motion(pose_.state, next.state);
  }
  return false;
}

bool PathFollower::step_over(double window, double row) {
  const double from = t_;
  // A gap without solution is plausible only where contacts change; elsewhere its start is a limit point. A path with
  // too many gaps is given up.
  if (pose_.state.contacts.empty() || ++stepped_over_ > kMaxSteppedOver) return false;
  snap_ = {0, 0};
  // Where a contact splits, its two halves separate a millionth of a degree later: start that close.
  for (const double fraction : {1e-5, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0}) {
    const double t = std::min(1.0, from + fraction * window);
    Balanced next;
    PoseReport report;
    if (balance_at(t, next, report)) {
      if (turning_back() && same_contacts(pose_.state, next.state) &&
          distance(solver_.model(), pose_.state, next.state) > kStepOverMotion) {
        // The stiffness vanished and no contact changed: a limit point, beyond which the joint snaps, however near.
        snap_ = largest_motion(pose_.state, next.state);
        return false;
      }
      // A row within the gap can still have a pose: that to which the joint slides.
      if (row < t && drives() && snap_to(row, false)) return true;
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

bool PathFollower::drives() const {
  return std::any_of(plan_.prescribed.begin(), plan_.prescribed.end(), [](const auto& p) { return p.from != p.to; });
}

PoseReport PathFollower::rest_at(double t, bool seeded, Balanced& next) {
  next = pose_;
  const Target target = plan_.target(t);
  PoseReport report = seeded ? solver_.settle_from_seed(next, target, true) : solver_.settle_downhill(next, target);
  iterations_ += report.iterations;
  if (seeded || report.status != PoseStatus::ok) return report;
  // Newton's method may have gone from the pose of rest to another equilibrium.
  if (stability_of(solver_, next, report, target).verdict == Stability::Verdict::stable) return report;
  report.status = PoseStatus::no_equilibrium;
  report.why = "no stable equilibrium was found beyond the end of the path";
  return report;
}

bool PathFollower::snap_to(double t, bool seeded) {
  Balanced next;
  const PoseReport report = rest_at(t, seeded, next);
  if (report.status != PoseStatus::ok) {
    no_rest_ = report;
    return false;
  }
  const auto [distance, angle] = largest_motion(pose_.state, next.state);
  const Balanced before = pose_;
  emit(PathEvent::Kind::snapped,
       fmt::format("to an equilibrium {:.2f} mm and {:.2f} deg away", 1e3 * distance, angle * 180 / M_PI));
  accept(t, std::move(next), report, true);
  emit(PathEvent::Kind::new_branch, to_string(stability()));
  report_changes(before, pose_);
  return true;
}

bool PathFollower::snap_beyond(double window) {
  no_rest_ = {};
  if (!drives()) return false;
  // A layer is its own foundation: with it descent is quicker than a slide.
  for (const bool seeded : {true, false}) {
    if (seeded && solver_.model().layers.empty()) continue;
    for (const double fraction : {0.03, 0.3, 1.0})
      if (snap_to(std::min(1.0, t_ + fraction * window), seeded)) return true;
  }
  return false;
}

bool PathFollower::turning_back() const {
  // Toward a limit point the smallest eigenvalue goes to 0 as the square root of the distance. The path was followed to
  // a distance of the smallest increment.
  return std::isfinite(stability().smallest) && std::abs(stability().smallest) < kVanishingStiffness * stiffest_seen_;
}

}  // namespace genu
