// Events within a continuation step of a PathFollower. They are reported and change nothing.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "genu/core/bracket.h"
#include "genu/equilibrium/state_difference.h"
#include "genu/path/flutter_tolerance.h"
#include "genu/path/path_cubic.h"
#include "genu/path/path_follower.h"
#include "genu/path/tolerances.h"

namespace genu {
void PathFollower::emit(PathEvent::Kind kind, const std::string& what) { emit_at(kind, t_, pose_.state, what); }

void PathFollower::emit_at(PathEvent::Kind kind, double t, const State& state, const std::string& what) {
  event_({kind, step_, t, plan_.target(t), what, state.coordinates});
}

double PathFollower::reaction_rate(const Tangent& tangent) const {
  return driven_ < 0 || tangent.motion.multipliers.size() <= driven_ ? 0.0 : tangent.motion.multipliers[driven_];
}

std::string PathFollower::reaction_words(const Tangent& after, const State& state) const {
  return genu::reaction_words(solver_.model(), plan_, driven_, reaction_rate(after), state);
}

PathFollower::Found PathFollower::locate(const Measure& measure, double t_end, const State& end, double tolerance) {
  const double after = measure(next_);
  Bracket bracket(t_, measure(tangent_), t_end, after, tolerance);
  Found out{t_end, end, after, true};
  State before = pose_.state, behind = end;
  while (bracket.open()) {
    const double t = bracket.next();
    Attempt trial = attempt(t);
    if (!trial.report.newton.converged() || !trial.valid() || far_from_predicted(trial)) return out;
    compute_tangent(trial.pose.state, t, between_);
    const double value = measure(between_);
    const bool is_before = opposite(value, after);
    is_before ? bracket.move_low(t, value) : bracket.move_high(t, value);
    (is_before ? before : behind) = trial.pose.state;
    out = {t, std::move(trial.pose.state), value, true};
  }
  out.leaps = distance(solver_.model(), before, behind) > kLeapDistance;
  return out;
}

bool PathFollower::find_stability_change(double t, const State& next, std::vector<Turn>& turns) {
  const char* verdict = to_string(next_.stability.verdict);
  const double before = stability().smallest, after = next_.stability.smallest;
  // The sign of a neutral stiffness is rounding. A step may end at a bifurcation; the next step reports it.
  constexpr auto kNeutral = Stability::Verdict::neutral;
  const bool definite = stability().verdict != kNeutral && next_.stability.verdict != kNeutral;
  if (stability().verdict == kNeutral && next_.stability.verdict != kNeutral && opposite(last_definite_, after)) {
    if (!next_.stability.flutter) turns.push_back({t_, PathEvent::Kind::bifurcation, pose_.state, verdict});
    turns.push_back({t_, PathEvent::Kind::stability_changed, pose_.state, verdict});
  } else if (definite && opposite(before, after)) {
    const Found there = locate([](const Tangent& x) { return x.stability.smallest; }, t, next);
    // On one branch the poses on both sides of the sign change meet. If they do not, the step has leapt to another
    // branch, possibly beyond a limit point.
    if (there.leaps) return false;
    // At the end of a load's scale the stiffness may jump and change sign without vanishing.
    const bool vanishes = std::abs(there.value) <= kVanishingShare * std::max(std::abs(before), std::abs(after));
    if (vanishes && !next_.stability.flutter && !stability().flutter)
      turns.push_back({there.t, PathEvent::Kind::bifurcation, there.state, verdict});
    turns.push_back({there.t, PathEvent::Kind::stability_changed, there.state, verdict});
  } else if (stability().verdict != next_.stability.verdict) {
    turns.push_back({t, PathEvent::Kind::stability_changed, next, verdict});
  }
  return true;
}

bool PathFollower::reaction_may_turn(double t, const State& next) const {
  const double before = reaction_rate(tangent_), after = reaction_rate(next_);
  if (!opposite(before, after)) return false;
  // A joint that hangs free has no reaction: the sign of its rate is rounding.
  const double largest =
      std::max(std::abs(pose_.state.multipliers[at(driven_)]), std::abs(next.multipliers[at(driven_)]));
  const double most = largest + (t - t_) * std::max(std::abs(before), std::abs(after));
  return most > reaction_noise(solver_.model(), plan_, driven_);
}

bool PathFollower::find_turns(double t, const State& next, std::vector<Turn>& turns) {
  if (!find_stability_change(t, next, turns)) return false;
  if (next_.stability.complex_pair && !stability().complex_pair) {
    const double tolerance = flutter_tolerance(solver_.model(), options_.event_tolerance, t - t_);
    const Found there =
        locate([](const Tangent& x) { return x.stability.complex_pair ? 1.0 : -1.0; }, t, next, tolerance);
    turns.push_back({there.t, PathEvent::Kind::flutter, there.state, "complex pair of stiffness eigenvalues"});
  }
  if (reaction_may_turn(t, next)) {
    const Found there = locate([this](const Tangent& x) { return reaction_rate(x); }, t, next);
    if (const std::string words = reaction_words(next_, there.state); !words.empty())
      turns.push_back({there.t, PathEvent::Kind::reaction_turns, there.state, words});
  }
  for (Turn& turn : law_turns(t, next)) turns.push_back(std::move(turn));
  find_shorter_sides(t, next, turns);
  std::stable_sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) { return a.t < b.t; });
  return true;
}

std::vector<PathFollower::Turn> PathFollower::law_turns(double t, const State& state, bool leaps) {
  std::vector<Turn> turns;
  if (law_events_.none()) return turns;
  const double h = t - t_;
  const bool first = substeps_ == 0;
  leaps = leaps || h == 0 || !same_contacts(pose_.state, state);
  const auto rate = [h](const Tangent& tangent) { return VecX(h * tangent.motion.twist); };
  const VecX before = rate(tangent_), after = rate(next_);
  const auto known = [&](const VecX& twist) { return twist.size() > 0 && twist.allFinite() ? &twist : nullptr; };
  LawEvents::Solves solves;
  std::optional<PathCubic> cubic;
  if (!leaps && known(before) && known(after) && held_count(pose_.state) == held_count(state))
    cubic.emplace(solver_.model(), pose_.state, tangent_.motion, state, next_.motion, h);
  // The next requested pose is near the last one, which Newton's method has found.
  State last;
  double last_u = -1;
  if (!leaps && known(before))
    solves.pose_at = [&](double u, State& out) {
      const bool near = std::abs(u - last_u) < kNearLastPose;
      const bool begun = near    ? retract(solver_.model(), last, tangent_.motion, (u - last_u) * h, out)
                         : cubic ? cubic->at(u, out)
                                 : retract(solver_.model(), pose_.state, tangent_.motion, u * h, out);
      if (!begun || !solver_.newton().solve(out, plan_.target(t_ + u * h), options_.newton).converged()) return false;
      last = out;
      last_u = u;
      return true;
    };
  const double tolerance = h > 0 ? options_.event_tolerance / h : 1;
  if (cubic)
    solves.event_at = [&](int ligament, double length, double& u, State& out) {
      double at = t_ + u * h;
      if (!cubic->at(u, out) || !event_newton_.solve(plan_, {ligament, length, law_events_.rounding(), tolerance * h},
                                                     options_.newton, solver_.newton().layers(), at, out))
        return false;
      u = (at - t_) / h;
      return true;
    };
  const LawEvents::End from{first ? state : pose_.state, known(before)}, to{state, known(after)};
  for (const LawEvents::Passed& p : law_events_.over(from, to, tolerance, solves))
    turns.push_back({t_ + p.u * h, p.kind, p.state, p.what});
  return turns;
}

void PathFollower::find_shorter_sides(double t, const State& next, std::vector<Turn>& turns) {
  for (std::size_t i = 0; i < side_watch_.count(); ++i) {
    const double after = side_watch_.carry(i, next) ? side_watch_.excess(i, next) : -1;
    if (!side_watch_.passed(i, after)) continue;
    Turn found{t_, PathEvent::Kind::wrap_side, pose_.state, side_watch_.what(i)};
    const double before = side_watch_.excess(i, pose_.state);
    Bracket bracket(t_, before, t, after, options_.event_tolerance);
    while (before < 0 && bracket.open()) {
      const double place = bracket.next();
      Attempt trial = attempt(place);
      if (!trial.report.newton.converged() || !trial.valid()) break;
      found.t = place;
      const double value = side_watch_.excess(i, trial.pose.state);
      value > 0 ? bracket.move_high(found.t, value) : bracket.move_low(found.t, value);
      found.state = std::move(trial.pose.state);
    }
    turns.push_back(std::move(found));
  }
}

void PathFollower::report_changes(const Balanced& before, const Balanced& after) {
  for (const auto& [kind, what] : changes(solver_.model(), before.state, after.state)) emit(kind, what);
}

}  // namespace genu
