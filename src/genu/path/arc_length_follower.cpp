#include "genu/path/arc_length_follower.h"

#include <algorithm>
#include <cmath>

#include "genu/core/bracket.h"
#include "genu/equilibrium/piece_changes.h"
#include "genu/equilibrium/state_difference.h"
#include "genu/path/tolerances.h"

namespace genu {

bool ArcLengthFollower::begin(const StepPlan& plan, const Balanced& pose, double t) {
  plan_ = plan;
  end_.reset();
  here_ = {};
  here_.at.pose = pose;
  here_.at.t = t;
  here_.report.status = PoseStatus::ok;
  if (!newton_.forward(plan_, pose.state, t, here_.at.direction)) {
    failure_.why = "more than one path continues from here";
    return false;
  }
  here_.stability = assess(pose.state);
  last_definite_ = here_.stability.verdict == Stability::Verdict::neutral ? 0 : here_.stability.smallest;
  return true;
}

Stability ArcLengthFollower::assess(const State& state) const {
  Stability out = assess_stability(newton_.linearization(), solver_.model().scales.length);
  if (!holds_a_drop(solver_.model(), state)) return out;
  // The stiffness at a drop of force is minus infinity, unlike that of a ligament held at a rise.
  out.smallest = -std::numeric_limits<double>::infinity();
  out.verdict = Stability::Verdict::unstable;
  return out;
}

ArcLengthFollower::Point ArcLengthFollower::attempt(const Point& from, double arc) {
  Point out = solve(from, arc);
  if (out.report.newton.converged())
    out.report = solver_.inspect(out.at.pose.state, NewtonReport(out.report.newton), out.findings);
  return out;
}

ArcLengthFollower::Point ArcLengthFollower::solve(const Point& from, double arc) {
  Point out;
  out.at.pose = from.at.pose;
  const NewtonReport newton = newton_.solve(plan_, from.at, arc, out.at);
  iterations_ += newton.iterations;
  out.report.newton = newton;
  if (!newton.converged()) {
    out.report.why = to_string(newton.outcome);
    return out;
  }
  out.directed = newton_.directed();
  out.stability = assess(out.at.pose.state);
  return out;
}

bool ArcLengthFollower::on_the_path(const Point& from, const Point& point, double arc) const {
  return newton_.product(from.at.direction, point.at.direction) > kMinTurnCosine &&
         newton_.strayed() <= kArcCorrectionShare * std::abs(arc) + kArcCorrectionSlack;
}

bool ArcLengthFollower::passes_through(const Point& from, const Point& to) const {
  return solver_.passes_through(from.at.pose.state, to.at.pose.state, true);
}

ArcLengthFollower::End ArcLengthFollower::follow(const StepPlan& plan, const Balanced& pose, const PoseReport& report,
                                                 double t) {
  if (!begin(plan, pose, t)) return End::stuck;
  here_.report = report;
  start_ = here_;
  double h = kFirstArc;
  while (!end_) {
    if (asked_to_stop(outputs_.cancelled)) return End::cancelled;
    if (here_.at.t < kFarthestBack || substeps_ > kMaxArcSubsteps) return End::ran_away;
    h = substep(h) ? std::min(1.5 * h, kLongestArc) : h / 2;
    if (h < kShortestArc) return End::stuck;
  }
  return *end_;
}

bool ArcLengthFollower::substep(double arc) {
  Point next = attempt(arc);
  if (next.report.newton.converged() && next.directed && on_the_path(here_, next, arc) &&
      !passes_through(here_, next)) {
    if (next.valid() && pass(arc, next)) return true;
    if (!next.findings.none()) return pass_change(arc, std::move(next));
  }
  failure_ = next.report;
  if (failure_.why.empty()) failure_.why = "the path bends too sharply to be followed, or leads through a body";
  return false;
}

bool ArcLengthFollower::pass_change(double arc, Point violated) {
  constexpr double kNoSide = std::numeric_limits<double>::infinity();
  Bracket bracket(0, kNoSide, arc, violated.findings.worst, options_.event_tolerance);
  Point last = here_;
  while (bracket.open()) {
    const double middle = bracket.next();
    Point trial = attempt(middle);
    const double worst = trial.findings.worst;
    if (trial.report.newton.converged() && trial.directed && trial.valid() && !passes_through(last, trial)) {
      bracket.move_low(middle, worst);
      last = std::move(trial);
    } else if (trial.report.newton.converged() && !trial.findings.none()) {
      bracket.move_high(middle, worst);
      violated = std::move(trial);
    } else {
      bracket.move_high(middle, kNoSide);
      failure_ = trial.report;
    }
  }
  if (bracket.low() > 0) {
    if (!pass(bracket.low(), std::move(last))) return false;
    if (end_) return true;
  }
  if (violated.findings.final()) {
    failure_ = violated.report;
    outputs_.event(end_of(violated.findings), violated, violated.findings.where);
    end_ = End::stuck;
    return true;
  }
  Point changed = violated;
  for (int i = 0; i < kMaxArcSetChanges; ++i) {
    // The active set that led here leads back along the path and not on.
    if (!change(changed) || same_set(here_.at.pose.state, changed.at.pose.state)) break;
    if (leave(changed)) return true;
  }
  // Several changes at one place: settle(), which also begins steps, finds the set beyond it.
  const PoseReport report = solver_.settle(violated.at.pose, plan_.target(violated.at.t));
  iterations_ += report.iterations;
  if (report.status == PoseStatus::ok &&
      distance(solver_.model(), here_.at.pose.state, violated.at.pose.state) < kSamePlace &&
      !same_set(here_.at.pose.state, violated.at.pose.state) && leave(violated))
    return true;
  failure_.why = "no active set continues from here";
  return false;
}

bool ArcLengthFollower::change(Point& point) {
  // A force that drops is followed down the drop, with the ligament held at its length while t decreases.
  constexpr bool kHoldDrops = true;
  return change_pieces(solver_.model(), point.findings, point.at.pose.state, kHoldDrops) ||
         solver_.change(point.at.pose, plan_.target(point.at.t), point.findings);
}

bool ArcLengthFollower::leave(Point& changed) {
  changed.findings = {};
  // The new set balances here too, because its new force or gap is zero. Along one of its two directions the released
  // contact opens and the gained one presses; t may grow or decrease there. Very close to the change both directions
  // may satisfy the tolerances: then the one with the larger margin is right.
  if (!newton_.direction(plan_, changed.at.pose.state, changed.at.t, here_.at.direction, changed.at.direction))
    return false;
  changed.stability = assess(changed.at.pose.state);
  Point back = changed;
  newton_.reverse(back.at.direction);
  const auto leads_on = [&](const Point& from, double arc, Point& trial) {
    trial = attempt(from, arc);
    return trial.report.newton.converged() && trial.directed && on_the_path(from, trial, arc) && trial.valid();
  };
  for (const double arc : {1e-6, 1e-5, 1e-4, 1e-3}) {
    Point onward, backward;
    const bool goes_on = leads_on(changed, arc, onward), goes_back = leads_on(back, arc, backward);
    const bool turns = goes_back && !(goes_on && onward.findings.worst >= backward.findings.worst);
    if (goes_on || turns) {
      depart(turns ? back : changed, arc, turns ? backward : onward);
      return true;
    }
    changed.findings = onward.findings;
  }
  return false;
}

void ArcLengthFollower::depart(const Point& changed, double arc, Point next) {
  const Point before = here_;
  if (!turns(before, changed)) add_rows_between(before, changed);
  if (end_) return;
  here_ = changed;
  here_.report = before.report;
  report_changes(before.at.pose, changed);
  const std::string verdict = to_string(next.stability.verdict);
  if (turns(before, changed)) outputs_.event(PathEvent::Kind::limit_point, changed, verdict);
  if (opposite(before.stability.smallest, changed.stability.smallest))
    outputs_.event(PathEvent::Kind::stability_changed, changed, verdict);
  if (!pass(arc, next)) accept(std::move(next));
}

bool ArcLengthFollower::same_set(const State& a, const State& b) {
  return same_contacts(a, b) &&
         std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(),
                    [](const auto& p, const auto& q) {
                      return p.ligament == q.ligament && p.piece == q.piece && p.held == q.held;
                    }) &&
         std::equal(a.wraps.begin(), a.wraps.end(), b.wraps.begin(), b.wraps.end(),
                    [](const WrapTouch& p, const WrapTouch& q) { return p.touching == q.touching; });
}

std::optional<ArcLengthFollower::Point> ArcLengthFollower::limit_ahead(const StepPlan& plan, const Balanced& pose,
                                                                       double t, double reach) {
  if (!begin(plan, pose, t)) return {};
  double walked = 0;
  for (double h = kFirstArc; walked < reach && h > kShortestArc;) {
    Point next = attempt(h);
    if (!next.report.newton.converged() || !next.directed || !on_the_path(here_, next, h) || !next.valid()) {
      h /= 2;
      continue;
    }
    const double before = here_.at.direction.parameter, after = next.at.direction.parameter;
    if (opposite(before, after)) {
      return locate([](const Point& p) { return p.at.direction.parameter; }, 0, here_, h, next).point;
    }
    here_ = std::move(next);
    walked += h;
    h = std::min(2 * h, kLongestArc);
  }
  return {};
}

std::optional<ArcLengthFollower::Point> ArcLengthFollower::turn_at_a_change(const StepPlan& plan, const Balanced& pose,
                                                                            const PoseReport& report, double t) {
  std::optional<Point> out;
  int looks = 0;
  const Cancelled cancelled = outputs_.cancelled;
  outputs_ = {
      [](int, const Point&) {},
      [&out](PathEvent::Kind kind, const Point& p, const std::string&) {
        if (kind == PathEvent::Kind::limit_point && !out) out = p;
      },
      [&out, &looks, cancelled] { return out.has_value() || ++looks > kMaxLimitLooks || asked_to_stop(cancelled); }};
  follow(plan, pose, report, t);
  return out;
}

}  // namespace genu
