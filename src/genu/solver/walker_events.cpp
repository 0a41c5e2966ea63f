// What happens on the way of a Walker, and where: it is told, and changes nothing.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/bracket.h"
#include "genu/solver/piece_changes.h"
#include "genu/solver/walker.h"

namespace genu {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void Walker::emit(PathEvent::Kind kind, const std::string& what) { emit_at(kind, t_, pose_.state, what); }

void Walker::emit_at(PathEvent::Kind kind, double t, const State& state, const std::string& what) {
  event_({kind, step_, t, plan_.target(t), what, state.coordinates});
}

double Walker::reaction_rate(const Tangent& tangent) const {
  return driven_ < 0 || tangent.motion.multipliers.size() <= driven_ ? 0.0 : tangent.motion.multipliers[driven_];
}

std::string Walker::reaction_words(const Tangent& after, const State& state) const {
  const bool angle = plan_.prescribed[at(driven_)].coordinate.is_rotation();
  return fmt::format("{} {:.9g} {}", reaction_rate(after) < 0 ? "largest" : "smallest", state.multipliers[at(driven_)],
                     angle ? "Nm" : "N");
}

std::optional<Walker::Attempt> Walker::locate(const std::function<double(const Tangent&)>& measure, double after,
                                              double t_end, double& where) {
  Bracket bracket(t_, measure(tangent_), t_end, after, options_.event_tolerance);
  std::optional<Attempt> found;
  while (bracket.open()) {
    const double t = bracket.next();
    Attempt trial = attempt(t);
    if (!trial.report.newton.converged() || !trial.valid() || far_from_predicted(trial)) break;
    compute_tangent(trial.pose.state, t, between_);
    const double value = measure(between_);
    opposite(value, after) ? bracket.move_low(t, value) : bracket.move_high(t, value);
    found = std::move(trial);
    where = t;
  }
  return found;
}

void Walker::mark_turns(double t, const State& next) {
  std::vector<Turn> turns = law_turns(t, next);
  double where = t;
  if (crosses_zero(stability(), next_.stability)) {
    const auto smallest = [](const Tangent& x) { return x.stability.smallest; };
    const auto found = locate(smallest, next_.stability.smallest, t, where);
    const State& state = found ? found->pose.state : next;
    if (!next_.stability.flutter && !stability().flutter)
      turns.push_back({where, PathEvent::Kind::bifurcation, state, to_string(next_.stability.verdict)});
    turns.push_back({where, PathEvent::Kind::stability_changed, state, to_string(next_.stability.verdict)});
  } else if (stability().verdict != next_.stability.verdict) {
    turns.push_back({t, PathEvent::Kind::stability_changed, next, to_string(next_.stability.verdict)});
  }
  const double rate = reaction_rate(next_);
  where = t;
  if (opposite(reaction_rate(tangent_), rate)) {
    const auto measure = [this](const Tangent& x) { return reaction_rate(x); };
    const auto found = locate(measure, rate, t, where);
    const State& state = found ? found->pose.state : next;
    turns.push_back({where, PathEvent::Kind::reaction_turns, state, reaction_words(next_, state)});
  }
  std::stable_sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) { return a.t < b.t; });
  for (const Turn& turn : turns) emit_at(turn.kind, turn.t, turn.state, turn.what);
}

std::vector<Walker::Turn> Walker::law_turns(double t, const State& state) {
  std::vector<Turn> turns;
  if (law_events_.none()) return turns;
  const double h = t - t_;
  const bool first = substeps_ == 0, leaps = h == 0 || !same_contacts(pose_.state, state);
  const auto rate = [h](const Tangent& tangent) { return VecX(h * tangent.motion.twist); };
  const VecX before = rate(tangent_), after = rate(next_);
  const auto known = [&](const VecX& twist) { return twist.size() > 0 && twist.allFinite() ? &twist : nullptr; };
  LawEvents::PoseAt pose_at;
  if (!leaps && known(before))
    pose_at = [&](double u, State& out) {
      return retract(solver_.model(), pose_.state, tangent_.motion, u * h, out) &&
             solver_.newton().solve(out, plan_.target(t_ + u * h), options_.newton).converged();
    };
  const LawEvents::End from{first ? state : pose_.state, known(before)}, to{state, known(after)};
  const double tolerance = h > 0 ? options_.event_tolerance / h : 1;
  for (const LawEvents::Passed& p : law_events_.over(from, to, tolerance, pose_at))
    turns.push_back({t_ + p.u * h, p.kind, p.state, p.what});
  return turns;
}

void Walker::report_changes(const Balanced& before, const Balanced& after) {
  const auto name = [&](const ActiveContact& c) {
    return fmt::format("{}.{}", solver_.model().pairs[at(c.pair)].name, c.number);
  };
  for (const ActiveContact& c : after.state.contacts)
    if (!contains(before.state, c)) emit(PathEvent::Kind::contact_gained, name(c));
  for (const ActiveContact& c : before.state.contacts)
    if (!contains(after.state, c)) emit(PathEvent::Kind::contact_lost, name(c));
  for (const auto& [kind, what] : piece_events(solver_.model(), before.state, after.state)) emit(kind, what);
}

void Walker::name_jump(const Attempt& violated, const Balanced& next, double t, PoseReport& report) {
  if (violated.findings.left_piece.empty()) return;
  const std::string where = piece_in_doubt(solver_.model(), violated.pose.state);
  // Where the force of a ligament drops the bodies may move on at once; where it rises they rest.
  constexpr double kRest = 1e-6;
  const double moved = report.status == PoseStatus::ok ? distance(pose_.state, next.state) : 1.0;
  if (where.empty() || moved <= kRest + 4 * (t - t_) * speed(tangent_)) return;
  emit(PathEvent::Kind::jump, where);
  if (report.status == PoseStatus::ok) return;
  law_jump_ = where;
  report.why = "no equilibrium is near beyond the jump of ligament " + where;
}

}  // namespace genu
