// Rows and events within a continuation step of an ArcLengthFollower.
#include <algorithm>
#include <cmath>

#include "genu/core/bracket.h"
#include "genu/equilibrium/state_difference.h"
#include "genu/path/arc_length_follower.h"
#include "genu/path/flutter_tolerance.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

constexpr const char* kFlutter = "complex pair of stiffness eigenvalues";

}  // namespace

bool ArcLengthFollower::turns(const Point& from, const Point& to) {
  // A joint that can slide freely under one load does so at constant t: the sign of dt/ds is then rounding.
  const double before = from.at.direction.parameter, after = to.at.direction.parameter;
  return opposite(before, after) && std::min(std::abs(before), std::abs(after)) > kNoDirection;
}

bool ArcLengthFollower::pass(double arc, Point next) {
  std::vector<Feature> found;
  if (!find_features(arc, next, found)) return false;
  for (Feature& f : found) {
    if (f.is_row)
      hand_over(f);
    else
      outputs_.event(f.kind, f.point, f.what);
    if (end_) return true;
  }
  accept(std::move(next));
  return true;
}

void ArcLengthFollower::accept(Point next) {
  solver_.follow_open(next.at.pose);
  here_ = std::move(next);
  if (here_.stability.verdict != Stability::Verdict::neutral) last_definite_ = here_.stability.smallest;
  ++substeps_;
}

void ArcLengthFollower::hand_over(Feature& row) {
  if (row.increment == 0 && closes(row.point)) {
    end_ = End::closed;
    return;
  }
  outputs_.row(row.increment, row.point);
  if (row.increment < plan_.increments) return;
  here_ = std::move(row.point);
  end_ = End::reached;
}

bool ArcLengthFollower::may_hide_turns(double arc, const Point& next) const {
  // t over the substep as the cubic of its values and rates. Where that all but stands still between two ends that move
  // on, t may turn back and forth there.
  if (arc <= kMinTurnArc) return false;
  const double a = here_.at.direction.parameter, b = next.at.direction.parameter;
  const double mean = (next.at.t - here_.at.t) / arc, bend = 3 * a + 3 * b - 6 * mean;
  if (a * b <= 0 || a * bend <= 0) return false;
  const double u = (2 * a + b - 3 * mean) / bend;
  if (!(u > 0 && u < 1)) return false;
  const double slowest = a * (1 - u) * (1 - 3 * u) + b * u * (3 * u - 2) + 6 * mean * u * (1 - u);
  return slowest / a < kSlowShare * std::min(1.0, b / a);
}

bool ArcLengthFollower::find_features(double arc, const Point& next, std::vector<Feature>& out) {
  if (may_hide_turns(arc, next)) return false;
  const std::string verdict = to_string(next.stability.verdict);
  double turned = std::numeric_limits<double>::infinity();
  if (turns(here_, next)) {
    const Measure turn = [](const Point& p) { return p.at.direction.parameter; };
    const Found limit = locate(turn, 0, here_, arc, next);
    turned = limit.arc;
    out.push_back({turned, limit.point, PathEvent::Kind::limit_point, 0, false, verdict});
    add_rows(0, here_, turned, limit.point, out);
    add_rows(turned, limit.point, arc, next, out);
  } else {
    add_rows(0, here_, arc, next, out);
  }
  for (const Feature& row : out) {
    if (!row.is_row || row.increment < plan_.increments || !(row.arc < arc)) continue;
    // The step ends here; later events do not belong to it.
    const Feature last = row;
    out.clear();
    return find_features(last.arc, last.point, out);
  }
  if (!add_stability(arc, next, turned, out)) return false;
  add_reaction_turn(arc, next, out);
  if (!law_events_.none()) add_law_events(arc, next, out);
  std::stable_sort(out.begin(), out.end(), [](const Feature& a, const Feature& b) { return a.arc < b.arc; });
  return true;
}

bool ArcLengthFollower::add_stability(double arc, const Point& next, double turned, std::vector<Feature>& out) {
  const std::string verdict = to_string(next.stability.verdict);
  if (next.stability.complex_pair && !here_.stability.complex_pair) {
    const Measure complex = [](const Point& p) { return p.stability.complex_pair ? 1.0 : -1.0; };
    const Found there = locate(complex, 0, here_, arc, next, flutter_tolerance(solver_.model(), kEventArc, arc));
    out.push_back({there.arc, there.point, PathEvent::Kind::flutter, 0, false, kFlutter});
  }
  const double before = here_.stability.smallest, after = next.stability.smallest;
  constexpr auto kNeutral = Stability::Verdict::neutral;
  if (next.stability.verdict == kNeutral || here_.stability.verdict == kNeutral) {
    add_neutral(arc, next, out);
    return true;
  }
  if (!opposite(before, after)) return true;
  const Measure smallest = [](const Point& p) { return p.stability.smallest; };
  Found there = locate(smallest, 0, here_, arc, next);
  if (there.leaps && arc > kMinLeapArc) return false;
  // At the end of a load's scale the stiffness may jump and change sign without vanishing.
  const bool vanishes = std::abs(there.value) <= kVanishingShare * std::max(std::abs(before), std::abs(after));
  if (std::abs(there.arc - turned) <= kSameTurn)
    there.arc = turned;
  else if (vanishes && !next.stability.flutter)
    out.push_back({there.arc, there.point, PathEvent::Kind::bifurcation, 0, false, verdict});
  out.push_back({there.arc, there.point, PathEvent::Kind::stability_changed, 0, false, verdict});
  return true;
}

void ArcLengthFollower::add_law_events(double arc, const Point& next, std::vector<Feature>& out) {
  const auto rate = [arc](const Point& p) { return VecX(arc * p.at.direction.twist); };
  const VecX before = rate(here_), after = rate(next);
  const LawEvents::PoseAt pose_at = [&](double u, State& state) {
    Point trial = solve(here_, u * arc);
    state = std::move(trial.at.pose.state);
    return trial.report.newton.converged();
  };
  const LawEvents::End from{here_.at.pose.state, &before}, to{next.at.pose.state, &after};
  for (const LawEvents::Passed& p : law_events_.over(from, to, options_.event_tolerance, {pose_at, {}}))
    out.push_back({p.u * arc, solve(here_, p.u * arc), p.kind, 0, false, p.what});
}

void ArcLengthFollower::add_neutral(double arc, const Point& next, std::vector<Feature>& out) {
  // The sign of a stiffness that is none is rounding. A substep may end at a bifurcation; the next one tells.
  if (next.stability.verdict == here_.stability.verdict) return;
  const std::string verdict = to_string(next.stability.verdict);
  const bool passes =
      here_.stability.verdict == Stability::Verdict::neutral && opposite(last_definite_, next.stability.smallest);
  if (passes && !next.stability.flutter && std::abs(here_.at.direction.parameter) > kTurningRate)
    out.push_back({0, here_, PathEvent::Kind::bifurcation, 0, false, verdict});
  out.push_back({passes ? 0 : arc, passes ? here_ : next, PathEvent::Kind::stability_changed, 0, false, verdict});
}

void ArcLengthFollower::add_reaction_turn(double arc, const Point& next, std::vector<Feature>& out) {
  const int driven = plan_.only_driven();
  if (driven < 0) return;
  const Measure rate = [driven](const Point& p) { return p.at.direction.multipliers[driven]; };
  if (!opposite(rate(here_), rate(next))) return;
  const Found there = locate(rate, 0, here_, arc, next);
  const std::string words = reaction_words(solver_.model(), plan_, driven, rate(next), there.point.at.pose.state);
  if (!words.empty()) out.push_back({there.arc, there.point, PathEvent::Kind::reaction_turns, 0, false, words});
}

void ArcLengthFollower::add_rows(double low, const Point& from, double high, const Point& to,
                                 std::vector<Feature>& out) {
  for (const int k : rows_between(from.at.t, to.at.t)) {
    const double t = static_cast<double>(k) / plan_.increments;
    const Measure past = [t](const Point& p) { return p.at.t - t; };
    Found there{high, to, 0, false};
    if (to.at.t != t) there = locate(past, low, from, high, to);
    if (!settle_on(t, there.point)) {
      Findings none;
      there.point.report = solver_.inspect(there.point.at.pose.state, NewtonReport(there.point.report.newton), none);
    }
    out.push_back({there.arc, std::move(there.point), PathEvent::Kind::limit_point, k, true, {}});
  }
}

void ArcLengthFollower::add_rows_between(const Point& before, const Point& changed) {
  // The bracket of the change has two ends; a row within it belongs to one set or the other.
  for (const int k : rows_between(before.at.t, changed.at.t)) {
    const double t = static_cast<double>(k) / plan_.increments;
    Point there = before;
    if (!settle_on(t, there)) {
      there = changed;
      there.report = before.report;
      settle_on(t, there);
    }
    Feature row{0, std::move(there), PathEvent::Kind::limit_point, k, true, {}};
    hand_over(row);
    if (end_) return;
  }
}

std::vector<int> ArcLengthFollower::rows_between(double from, double to) const {
  const double a = from * plan_.increments, b = to * plan_.increments;
  const int step = b > a ? 1 : -1;
  std::vector<int> out;
  if (std::abs(to - from) <= kNoProgress) return out;
  for (int k = static_cast<int>(step > 0 ? std::floor(a) + 1 : std::ceil(a) - 1); step > 0 ? k <= b : k >= b;
       k += step) {
    out.push_back(k);
    if (k >= plan_.increments) break;
  }
  return out;
}

ArcLengthFollower::Found ArcLengthFollower::locate(const Measure& measure, double low, const Point& from, double high,
                                                   const Point& to) {
  return locate(measure, low, from, high, to, kEventArc);
}

ArcLengthFollower::Found ArcLengthFollower::locate(const Measure& measure, double low, const Point& from, double high,
                                                   const Point& to, double tolerance) {
  const double after = measure(to);
  Bracket bracket(low, measure(from), high, after, tolerance);
  Found best{high, to, after, true};
  Balanced before = from.at.pose, behind = to.at.pose;
  while (bracket.open()) {
    // Where no pose is found at one place (at a bifurcation the Jacobian is singular), there is one beside it.
    double middle = bracket.next();
    Point trial = solve(here_, middle);
    for (const double share : {0.5, 0.25, 0.75, 0.4, 0.6}) {
      if (trial.report.newton.converged()) break;
      middle = bracket.low() + share * bracket.width();
      trial = solve(here_, middle);
    }
    if (!trial.report.newton.converged()) return best;
    const double value = measure(trial);
    const bool is_before = opposite(value, after);
    is_before ? bracket.move_low(middle, value) : bracket.move_high(middle, value);
    (is_before ? before : behind) = trial.at.pose;
    best = {middle, std::move(trial), value, true};
    if (value == 0) before = behind;
    if (value == 0) break;
  }
  best.leaps = distance(solver_.model(), before.state, behind.state) > kArcLeap;
  return best;
}

bool ArcLengthFollower::settle_on(double t, Point& point) {
  // Solves at the row's exact value of t. Near a limit point two poses have that value; the one on this side is kept.
  Balanced pose = point.at.pose;
  Findings findings;
  const PoseReport report = solver_.solve_held(pose, plan_.target(t), findings);
  iterations_ += report.iterations;
  if (report.status != PoseStatus::ok || !findings.none() ||
      distance(solver_.model(), pose.state, point.at.pose.state) > kRowLeap)
    return false;
  solver_.follow_open(pose);
  point.at.pose = std::move(pose);
  point.at.t = t;
  point.report = report;
  return true;
}

bool ArcLengthFollower::closes(const Point& point) const {
  return substeps_ > 0 && distance(solver_.model(), point.at.pose.state, start_.at.pose.state) < kLoopClosed &&
         newton_.product(point.at.direction, start_.at.direction) > 0;
}

void ArcLengthFollower::report_changes(const Balanced& before, const Point& after) {
  for (const auto& [kind, what] : changes(solver_.model(), before.state, after.at.pose.state))
    outputs_.event(kind, after, what);
}

}  // namespace genu
