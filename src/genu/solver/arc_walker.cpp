#include "genu/solver/arc_walker.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/bracket.h"
#include "genu/solver/piece_changes.h"

namespace genu {
namespace {

constexpr double kFirst = 0.01, kLongest = 0.1, kShortest = 1e-9;  // of a substep, in arc length
constexpr double kSharpest = 0.95;     // cosine of the angle between the directions at a substep's ends
constexpr double kFarthestBack = -10;  // of t: a path that runs away is not followed for ever
constexpr int kMostSubsteps = 100000;
constexpr double kClosed = 1e-6;  // characteristic lengths, rad: nearer than this the path is back at its start

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

bool ArcWalker::begin(const StepPlan& plan, const Balanced& pose, double t) {
  plan_ = plan;
  end_.reset();
  here_ = {};
  here_.at.pose = pose;
  here_.at.t = t;
  here_.report.status = PoseStatus::ok;
  if (!newton_.forward(plan_, pose.state, t, here_.at.direction)) {
    failure_.why = "more than one path leads on from here";
    return false;
  }
  here_.stability = assess_stability(newton_.linearization(), solver_.model().scales.length);
  return true;
}

ArcWalker::Point ArcWalker::attempt(double arc) {
  Point out;
  out.at.pose = here_.at.pose;
  const NewtonReport newton = newton_.solve(plan_, here_.at, arc, out.at);
  iterations_ += newton.iterations;
  if (!newton.converged()) {
    out.report.newton = newton;
    out.report.why = to_string(newton.outcome);
    return out;
  }
  out.stability = assess_stability(newton_.linearization(), solver_.model().scales.length);
  out.report = solver_.inspect(out.at.pose.state, newton, out.findings);
  return out;
}

bool ArcWalker::on_the_path(const Point& point, double arc) const {
  constexpr double kStrayed = 0.3, kSlack = 1e-7;
  return newton_.product(here_.at.direction, point.at.direction) > kSharpest &&
         newton_.strayed() <= kStrayed * std::abs(arc) + kSlack;
}

ArcWalker::End ArcWalker::walk(const StepPlan& plan, const Balanced& pose, const PoseReport& report) {
  if (!begin(plan, pose, 0)) return End::stuck;
  here_.report = report;
  start_ = here_;
  double h = kFirst;
  while (!end_) {
    if (outputs_.cancelled && outputs_.cancelled()) return End::cancelled;
    if (here_.at.t < kFarthestBack || substeps_ > kMostSubsteps) return End::ran_away;
    h = substep(h) ? std::min(1.5 * h, kLongest) : h / 2;
    if (h < kShortest) return End::stuck;
  }
  return *end_;
}

bool ArcWalker::substep(double arc) {
  Point next = attempt(arc);
  if (next.report.newton.converged() && on_the_path(next, arc)) {
    if (next.valid()) return pass(arc, std::move(next));
    if (!next.findings.none()) return pass_contact_change(arc, std::move(next));
  }
  failure_ = next.report;
  if (failure_.why.empty()) failure_.why = "the path bends too sharply to be followed";
  return false;
}

bool ArcWalker::pass(double arc, Point next) {
  for (Feature& f : features(arc, next)) {
    if (!f.is_row) {
      outputs_.event(f.kind, f.point, f.what);
      continue;
    }
    if (f.increment == 0 && closes(f.point)) {
      end_ = End::closed;
      return true;
    }
    outputs_.row(f.increment, f.point);
    if (f.increment < plan_.increments) continue;
    here_ = std::move(f.point);
    end_ = End::reached;
    return true;
  }
  solver_.follow_open(next.at.pose);
  here_ = std::move(next);
  ++substeps_;
  return true;
}

std::vector<ArcWalker::Feature> ArcWalker::features(double arc, const Point& next) {
  std::vector<Feature> out;
  const double turn_before = here_.at.direction.parameter, turn_after = next.at.direction.parameter;
  const bool restless = crosses_zero(here_.stability, next.stability);
  const std::string verdict = to_string(next.stability.verdict);
  double where = 0;
  if (opposite(turn_before, turn_after)) {
    const Measure turn = [](const Point& p) { return p.at.direction.parameter; };
    const Point limit = locate(turn, 0, turn_before, arc, turn_after, where);
    out.push_back({where, limit, PathEvent::Kind::limit_point, 0, false, verdict});
    if (restless) out.push_back({where, limit, PathEvent::Kind::stability_changed, 0, false, verdict});
    add_rows(0, here_, where, limit, out);
    add_rows(where, limit, arc, next, out);
  } else {
    add_rows(0, here_, arc, next, out);
    if (restless) {
      const Measure smallest = [](const Point& p) { return p.stability.smallest; };
      const Point there = locate(smallest, 0, here_.stability.smallest, arc, next.stability.smallest, where);
      if (!next.stability.flutter) out.push_back({where, there, PathEvent::Kind::bifurcation, 0, false, verdict});
      out.push_back({where, there, PathEvent::Kind::stability_changed, 0, false, verdict});
    }
  }
  if (!law_events_.none()) add_law_events(arc, next, out);
  std::stable_sort(out.begin(), out.end(), [](const Feature& a, const Feature& b) { return a.arc < b.arc; });
  return out;
}

void ArcWalker::add_law_events(double arc, const Point& next, std::vector<Feature>& out) {
  const auto rate = [arc](const Point& p) { return VecX(arc * p.at.direction.twist); };
  const VecX before = rate(here_), after = rate(next);
  const LawEvents::PoseAt pose_at = [&](double u, State& state) {
    Point trial = attempt(u * arc);
    state = std::move(trial.at.pose.state);
    return trial.report.newton.converged();
  };
  const LawEvents::End from{here_.at.pose.state, &before}, to{next.at.pose.state, &after};
  for (const LawEvents::Passed& p : law_events_.over(from, to, options_.event_tolerance, pose_at))
    out.push_back({p.u * arc, attempt(p.u * arc), p.kind, 0, false, p.what});
}

void ArcWalker::add_rows(double low, const Point& from, double high, const Point& to, std::vector<Feature>& out) {
  const double n = plan_.increments, a = from.at.t * n, b = to.at.t * n;
  const int step = b > a ? 1 : -1;
  const int first = static_cast<int>(step > 0 ? std::floor(a) + 1 : std::ceil(a) - 1);
  for (int k = first; step > 0 ? k <= b : k >= b; k += step) {
    const double t = k / n;
    double where = high;
    const Measure past = [t](const Point& p) { return p.at.t - t; };
    Point there = k == b ? to : locate(past, low, from.at.t - t, high, to.at.t - t, where);
    settle_on(t, there);
    out.push_back({where, std::move(there), PathEvent::Kind::limit_point, k, true, {}});
    if (k >= plan_.increments) return;
  }
}

ArcWalker::Point ArcWalker::locate(const Measure& measure, double low, double low_value, double high, double high_value,
                                   double& arc) {
  constexpr double kFine = 1e-11;
  Bracket bracket(low, low_value, high, high_value, kFine);
  Point best = attempt(high);
  arc = high;
  while (bracket.open()) {
    const double middle = bracket.next();
    Point trial = attempt(middle);
    if (!trial.report.newton.converged()) break;
    const double value = measure(trial);
    opposite(value, high_value) ? bracket.move_low(middle, value) : bracket.move_high(middle, value);
    best = std::move(trial);
    arc = middle;
    if (value == 0) break;
  }
  return best;
}

void ArcWalker::settle_on(double t, Point& point) {
  // On the row's own value to the last digit; but near a limit point two poses share it, and the right one is kept.
  constexpr double kSame = 1e-5;
  Balanced pose = point.at.pose;
  Findings findings;
  const PoseReport report = solver_.solve_held(pose, plan_.target(t), findings);
  iterations_ += report.iterations;
  const Pose &X = pose.state.poses.back(), &X_before = point.at.pose.state.poses.back();
  const double moved =
      (X.p - X_before.p).norm() / solver_.model().scales.length + log_rotation(X.R * X_before.R.transpose()).norm();
  if (report.status != PoseStatus::ok || !findings.none() || moved > kSame) return;
  solver_.follow_open(pose);
  point.at.pose = std::move(pose);
  point.at.t = t;
  point.report = report;
}

bool ArcWalker::closes(const Point& point) const {
  if (substeps_ == 0) return false;
  double sum = 0;
  const auto &now = point.at.pose.state.poses, &then = start_.at.pose.state.poses;
  for (std::size_t i = 0; i < now.size(); ++i)
    sum += (now[i].p - then[i].p).norm() / solver_.model().scales.length +
           log_rotation(now[i].R * then[i].R.transpose()).norm();
  return sum < kClosed && newton_.product(point.at.direction, start_.at.direction) > 0;
}

bool ArcWalker::pass_contact_change(double arc, Point violated) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  Bracket bracket(0, kUnknown, arc, violated.findings.worst, options_.event_tolerance);
  Point last = here_;
  while (bracket.open()) {
    const double middle = bracket.next();
    Point trial = attempt(middle);
    const double worst = trial.findings.worst;
    if (trial.report.newton.converged() && trial.valid()) {
      bracket.move_low(middle, worst);
      last = std::move(trial);
    } else if (trial.report.newton.converged() && !trial.findings.none()) {
      bracket.move_high(middle, worst);
      violated = std::move(trial);
    } else {
      bracket.move_high(middle, kUnknown);
      failure_ = trial.report;
    }
  }
  if (bracket.low() > 0) {
    pass(bracket.low(), std::move(last));
    if (end_) return true;
  }
  if (violated.findings.over_edge || violated.findings.deep_overlap) {
    failure_ = violated.report;
    outputs_.event(violated.findings.over_edge ? PathEvent::Kind::over_edge : PathEvent::Kind::overlap, violated,
                   violated.findings.where);
    return false;
  }
  constexpr int kChanges = 6;
  Point changed = std::move(violated);
  for (int i = 0; i < kChanges; ++i) {
    if (!solver_.change(changed.at.pose, plan_.target(changed.at.t), changed.findings)) break;
    if (leave(changed)) return true;
  }
  failure_.why = "no set of contacts leads on from here";
  return false;
}

bool ArcWalker::leave(Point& changed) {
  // The new set balances here too, its new force or gap being zero. Of its two directions one opens what was released
  // and presses what was gained, whether t grows that way or not.
  const Point before = here_;
  Correction along = before.at.direction;
  if (!newton_.direction(plan_, changed.at.pose.state, changed.at.t, along, changed.at.direction)) return false;
  here_ = changed;
  for (const bool onward : {true, false}) {
    if (!onward) newton_.reverse(here_.at.direction);
    for (const double arc : {1e-6, 1e-5, 1e-4, 1e-3}) {
      Point trial = attempt(arc);
      if (!trial.report.newton.converged() || !trial.valid() || !on_the_path(trial, arc)) {
        if (onward) changed.findings = trial.findings;
        continue;
      }
      solver_.follow_open(trial.at.pose);
      here_ = std::move(trial);
      ++substeps_;
      report_changes(before.at.pose, changed);
      const std::string verdict = to_string(here_.stability.verdict);
      if (opposite(before.at.direction.parameter, here_.at.direction.parameter))
        outputs_.event(PathEvent::Kind::limit_point, changed, verdict);
      if (crosses_zero(before.stability, here_.stability))
        outputs_.event(PathEvent::Kind::stability_changed, changed, verdict);
      return true;
    }
  }
  here_ = before;
  return false;
}

void ArcWalker::report_changes(const Balanced& before, const Point& after) {
  const auto report = [&](const State& from, const State& to, PathEvent::Kind kind) {
    for (const ActiveContact& c : to.contacts)
      if (!contains(from, c))
        outputs_.event(kind, after, fmt::format("{}.{}", solver_.model().pairs[at(c.pair)].name, c.number));
  };
  report(before.state, after.at.pose.state, PathEvent::Kind::contact_gained);
  report(after.at.pose.state, before.state, PathEvent::Kind::contact_lost);
  for (const auto& [kind, what] : piece_events(solver_.model(), before.state, after.at.pose.state))
    outputs_.event(kind, after, what);
}

std::optional<ArcWalker::Point> ArcWalker::limit_ahead(const StepPlan& plan, const Balanced& pose, double t,
                                                       double reach) {
  if (!begin(plan, pose, t)) return {};
  double walked = 0;
  for (double h = kFirst; walked < reach && h > kShortest;) {
    Point next = attempt(h);
    if (!next.report.newton.converged() || !on_the_path(next, h) || !next.valid()) {
      h /= 2;
      continue;
    }
    const double before = here_.at.direction.parameter, after = next.at.direction.parameter;
    if (opposite(before, after)) {
      double where = 0;
      return locate([](const Point& p) { return p.at.direction.parameter; }, 0, before, h, after, where);
    }
    here_ = std::move(next);
    walked += h;
    h = std::min(2 * h, kLongest);
  }
  return {};
}

}  // namespace genu
