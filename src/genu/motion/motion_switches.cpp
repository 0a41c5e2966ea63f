#include "genu/motion/motion_switches.h"

#include <algorithm>
#include <cmath>

#include "genu/model/ligament_pieces.h"
#include "genu/model/linearization.h"
#include "genu/model/twist.h"
#include "genu/motion/tolerances.h"

namespace genu {
namespace {

LigamentPiece* piece_of(State& state, int ligament) {
  const auto found = std::find_if(state.pieces.begin(), state.pieces.end(),
                                  [&](const LigamentPiece& p) { return p.ligament == ligament; });
  return found == state.pieces.end() ? nullptr : &*found;
}

PathEvent named(PathEvent::Kind kind, const MotionPoint& point, const std::string& what) {
  PathEvent event;
  event.kind = kind;
  event.step = 1;
  event.target.time = point.time;
  event.what = what;
  event.coordinates = point.state.coordinates;
  return event;
}

}  // namespace

MotionSwitches::MotionSwitches(const JointModel& model) : model_(model) {
  for (int i = 0; i < static_cast<int>(model.ligaments.size()); ++i) {
    const auto& l = model.ligaments[at(i)];
    for (int b = 0; b < static_cast<int>(l.law.breaks().size()); ++b) watches_.push_back({i, b});
    if (l.damping > 0 && !pushes(l.law)) watches_.push_back({i, -1});
  }
  for (const JointSpring& spring : model.joint_springs)
    for (const double angle : {spring.lower, spring.upper})
      if (std::isfinite(angle)) limits_.push_back({spring.joint, angle});
  sides_.assign(at(count()), 1);
}

void MotionSwitches::values(const MotionPoint& point, const std::vector<DamperMode>& modes, double* out) const {
  unshifted(point, modes, out);
  for (std::size_t k = 0; k < sides_.size(); ++k) out[k] += kRootShift * sides_[k];
}

/// By their values, or by their rates where the values are close to 0.
void MotionSwitches::choose_sides(const MotionPoint& point, const std::vector<DamperMode>& modes) {
  std::vector<double> now(sides_.size());
  unshifted(point, modes, now.data());
  for (std::size_t k = 0; k < sides_.size(); ++k) {
    double toward = now[k];
    if (std::abs(now[k]) <= kSideRounding && k < watches_.size() && watches_[k].law_break < 0) {
      toward = modes[at(watches_[k].ligament)] == DamperMode::relaxed ? -1 : 1;
    } else if (std::abs(now[k]) <= kSideRounding) {
      const double rate = k < watches_.size()
                              ? model_.ligaments[at(watches_[k].ligament)].path.length_rate(
                                    point.state.poses, point.twist, point.state.wraps)
                              : joint_point(model_, point.state, limits_[k - watches_.size()].joint)
                                    .gradient(0)
                                    .dot(twist_of_pair(model_, limits_[k - watches_.size()].joint, point.twist));
      if (rate != 0) toward = rate;
    }
    sides_[k] = toward < 0 ? -1 : 1;
  }
}

void MotionSwitches::unshifted(const MotionPoint& point, const std::vector<DamperMode>& modes, double* out) const {
  for (const Watch& w : watches_) {
    const auto& l = model_.ligaments[at(w.ligament)];
    if (w.law_break >= 0) {
      const double length = l.law.breaks()[at(w.law_break)].length;
      *out++ = (l.path.length(point.state.poses, point.state.wraps) - length) / model_.scales.length;
      continue;
    }
    const double rate = l.path.length_rate(point.state.poses, point.twist, point.state.wraps);
    const double tension = show_ligament(model_, point.state, w.ligament).force + l.damping * rate;
    *out++ = modes[at(w.ligament)] == DamperMode::slack ? 1 : tension / model_.scales.force;
  }
  for (const Limit& limit : limits_) *out++ = point.state.coordinates[at(limit.joint)][0] - limit.angle;
}

void MotionSwitches::settle(const MotionPoint& point, State& pieces, std::vector<DamperMode>& modes) {
  State state = point.state;
  reset_pieces(model_, state);
  for (const Watch& w : watches_) {  // at a break the speed decides the side
    const auto& l = model_.ligaments[at(w.ligament)];
    LigamentPiece* piece = piece_of(state, w.ligament);
    if (w.law_break < 0 || piece == nullptr) continue;
    const double past = l.path.length(state.poses, state.wraps) - l.law.breaks()[at(w.law_break)].length;
    const double rate = l.path.length_rate(state.poses, point.twist, state.wraps);
    if (std::abs(past) > kSideRounding * model_.scales.length || rate == 0) continue;
    const double beside =
        l.path.length(state.poses, state.wraps) + (rate > 0 ? 2 : -2) * kSideRounding * model_.scales.length;
    piece->piece = l.law.piece_at(beside);
  }
  pieces.pieces = state.pieces;
  modes = damper_modes(model_, state, point.twist);
  choose_sides(point, modes);
}

std::vector<PathEvent> MotionSwitches::switch_over(const std::vector<int>& roots, const MotionPoint& point,
                                                   State& pieces, std::vector<DamperMode>& modes) {
  std::vector<PathEvent> events;
  for (std::size_t k = 0; k < sides_.size(); ++k)
    if (roots[k] != 0) sides_[k] = roots[k] > 0 ? 1 : -1;
  for (std::size_t k = 0; k < watches_.size(); ++k) {
    if (roots[k] == 0) continue;
    const bool up = roots[k] > 0;
    const int i = watches_[k].ligament;
    const auto& l = model_.ligaments[at(i)];
    DamperMode& mode = modes[at(i)];
    if (watches_[k].law_break < 0) {
      if (mode == DamperMode::slack) continue;
      mode = up ? DamperMode::taut : DamperMode::relaxed;
      events.push_back(named(up ? PathEvent::Kind::taut : PathEvent::Kind::slack, point,
                             l.name + (up ? ": its damper pulls again" : ": it shortens faster than its law pulls")));
      continue;
    }
    const LawBreak& b = l.law.breaks()[at(watches_[k].law_break)];
    const LawBreak::Side& side = up ? b.above : b.below;
    const auto& sharp = l.law.sharp_breaks();
    for (int s = 0; s < static_cast<int>(sharp.size()); ++s)
      if (sharp[at(s)].length == b.length)
        if (LigamentPiece* piece = piece_of(pieces, i)) piece->piece = up ? s + 1 : s;
    PathEvent::Kind kind = PathEvent::Kind::transition;
    if (b.above.slack != b.below.slack) {
      kind = side.slack ? PathEvent::Kind::slack : PathEvent::Kind::taut;
      if (l.damping > 0) mode = side.slack ? DamperMode::slack : DamperMode::taut;
    }
    events.push_back(named(kind, point, l.name));
  }
  for (std::size_t k = 0; k < limits_.size(); ++k)
    if (roots[watches_.size() + k] != 0)
      events.push_back(
          named(PathEvent::Kind::transition, point, model_.joints[at(limits_[k].joint)].name + ": passes its limit"));
  return events;
}

bool MotionSwitches::astray(const MotionPoint& point, const State& pieces, const std::vector<DamperMode>& modes) const {
  const double least = kSideRounding * model_.scales.length;
  for (const LigamentPiece& p : pieces.pieces) {
    const auto& l = model_.ligaments[at(p.ligament)];
    const auto& sharp = l.law.sharp_breaks();
    const double length = l.path.length(point.state.poses, point.state.wraps);
    if (p.piece > 0 && length < sharp[at(p.piece - 1)].length - least) return true;
    if (p.piece < static_cast<int>(sharp.size()) && length > sharp[at(p.piece)].length + least) return true;
  }
  const std::vector<DamperMode> wanted = damper_modes(model_, point.state, point.twist);
  for (const Watch& w : watches_) {
    const DamperMode is = modes[at(w.ligament)], should = wanted[at(w.ligament)];
    if (w.law_break >= 0 || is == should) continue;
    const auto& l = model_.ligaments[at(w.ligament)];
    const double past = l.path.length(point.state.poses, point.state.wraps) - l.law.slack_until();
    const double rate = l.path.length_rate(point.state.poses, point.twist, point.state.wraps);
    const double tension = show_ligament(model_, point.state, w.ligament).force + l.damping * rate;
    const bool by_length = is == DamperMode::slack || should == DamperMode::slack;
    if (by_length ? std::abs(past) > least : std::abs(tension) > kSideRounding * model_.scales.force) return true;
  }
  return false;
}

}  // namespace genu
