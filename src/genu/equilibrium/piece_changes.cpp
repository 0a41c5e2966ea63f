#include "genu/equilibrium/piece_changes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

const std::vector<LawBreak>& breaks_of(const JointModel& model, const LigamentPiece& piece) {
  return model.ligaments[at(piece.ligament)].law.sharp_breaks();
}

double length_of(const JointModel& model, const State& state, const LigamentPiece& piece) {
  return model.ligaments[at(piece.ligament)].path.length(state.poses, state.wraps);
}

/// Distance of a ligament from the ends of its piece, scaled; negative outside.
double margin(const JointModel& model, const State& state, const LigamentPiece& piece) {
  const auto& breaks = breaks_of(model, piece);
  const auto k = at(piece.piece);
  if (piece.held) {
    const auto [low, high] = std::minmax(breaks[k].below.force, breaks[k].above.force);
    return std::min(piece.force - low, high - piece.force) / model.scales.force;
  }
  const double length = length_of(model, state, piece);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double above = k > 0 ? length - breaks[k - 1].length : infinity;
  const double below = k < breaks.size() ? breaks[k].length - length : infinity;
  return std::min(above, below) / model.scales.length;
}

void hold(const LawBreak& b, int piece, bool from_below, LigamentPiece& out) {
  out.piece = piece;
  out.held = true;
  out.force = from_below ? b.below.force : b.above.force;
}

/// The break that a ligament off its piece has passed.
int break_passed(const JointModel& model, const State& state, const LigamentPiece& piece) {
  const auto& breaks = breaks_of(model, piece);
  const int k = piece.piece;
  return at(k) < breaks.size() && length_of(model, state, piece) > breaks[at(k)].length ? k : k - 1;
}

void move(const JointModel& model, const State& state, bool hold_drops, LigamentPiece& piece) {
  const auto& breaks = breaks_of(model, piece);
  const int k = piece.piece;
  if (piece.held) {
    piece.held = false;
    const LawBreak& left = breaks[at(k)];
    const bool above = std::abs(piece.force - left.above.force) < std::abs(piece.force - left.below.force);
    piece.piece = above ? k + 1 : k;
    return;
  }
  const int passed = break_passed(model, state, piece);
  const bool up = passed == k;
  const LawBreak& b = breaks[at(passed)];
  if (b.jumps() && (b.force_jump() > 0 || hold_drops))
    hold(b, passed, up, piece);
  else
    piece.piece = up ? k + 1 : k - 1;
}

}  // namespace

std::string path_about_to_slip(const JointModel& model, const State& state) {
  std::string out;
  if (state.wraps.empty()) return out;
  double least = kSlippingHold;
  for_each_path(model, [&](const LigamentPath& path, const std::string& name) {
    if (path.obstacles().empty()) return;
    const double hold = path.hold(state.poses, state.wraps);
    if (!(hold < least)) return;
    least = hold;
    out = name + " round";
    for (const LigamentPath::Obstacle& o : path.obstacles()) out += " " + o.name;
  });
  return out;
}

PathEvent::Kind passed(const LawBreak& b, bool up) {
  const LawBreak::Side &from = up ? b.below : b.above, &to = up ? b.above : b.below;
  if (from.slack != to.slack) return to.slack ? PathEvent::Kind::slack : PathEvent::Kind::taut;
  return PathEvent::Kind::transition;
}

namespace {

/// Whether a path is still a shortest one that presses on its surfaces all along.
void look_for_lost(const State& state, const LigamentPath& path, const std::string& name, double rounding,
                   Findings& out) {
  std::string on;
  for (std::size_t i = 0; i < path.obstacles().size(); ++i) {
    const WrapTouch& touch = state.wraps[path.touch_index(i)];
    if (!touch.touching) continue;
    if (touch.arc.length <= rounding) return;  // about to touch or to leave
    on += (on.empty() ? "" : ", ") + path.obstacles()[i].name;
    if (!(touch.arc.lift() > kHollowTolerance * touch.arc.length)) continue;
    out.lifts_off = true;
    out.where = fmt::format("{} on {} is hollow {:.3g} mm along its arc of {:.3g} mm", name, path.obstacles()[i].name,
                            to::kMillimetre * touch.arc.hollow_at, to::kMillimetre * touch.arc.length);
  }
  if (on.empty() || path.is_shortest(state.poses, state.wraps)) return;
  out.slips_off = true;
  out.where = name + " round " + on;
}

void inspect_wraps(const JointModel& model, const State& state, Findings& out) {
  out.left_touch.clear();
  out.slips_off = out.lifts_off = false;
  if (state.wraps.empty()) return;
  for_each_path(model, [&](const LigamentPath& path, const std::string& name) {
    for (std::size_t i = 0; i < path.obstacles().size(); ++i) {
      const std::size_t k = path.touch_index(i);
      if (state.wraps[k].by_length) continue;
      const double inside = path.touch_margin(state.poses, state.wraps, i) / model.scales.length;
      out.worst = std::min(out.worst, inside);
      if (inside < -kLengthRounding) out.left_touch.push_back(static_cast<int>(k));
    }
    if (!path.obstacles().empty() && out.left_touch.empty())
      look_for_lost(state, path, name, kLengthRounding * model.scales.length, out);
  });
}

void change_touches(const JointModel& model, const Findings& findings, State& state) {
  for_each_path(model, [&](const LigamentPath& path, const std::string&) {
    for (std::size_t i = 0; i < path.obstacles().size(); ++i)
      if (std::count(findings.left_touch.begin(), findings.left_touch.end(), static_cast<int>(path.touch_index(i))) > 0)
        path.switch_touch(state.poses, state.wraps, i);
  });
}

}  // namespace

void inspect_pieces(const JointModel& model, const State& state, Findings& out) {
  out.left_piece.clear();
  for (std::size_t i = 0; i < state.pieces.size(); ++i) {
    const LigamentPiece& piece = state.pieces[i];
    if (piece.by_length) continue;
    const double inside = margin(model, state, piece);
    out.worst = std::min(out.worst, inside);
    if (inside < -(piece.held ? kPullTolerance : kLengthRounding)) out.left_piece.push_back(static_cast<int>(i));
  }
  inspect_wraps(model, state, out);
}

double margin_of_change(const JointModel& model, const Findings& findings, const State& state) {
  if (!findings.left_piece.empty()) return margin(model, state, state.pieces[at(findings.left_piece.front())]);
  double out = std::numeric_limits<double>::quiet_NaN();
  for_each_path(model, [&](const LigamentPath& path, const std::string&) {
    for (std::size_t i = 0; i < path.obstacles().size(); ++i)
      if (static_cast<int>(path.touch_index(i)) == findings.left_touch.front())
        out = path.touch_margin(state.poses, state.wraps, i) / model.scales.length;
  });
  return out;
}

bool change_pieces(const JointModel& model, const Findings& findings, State& state, bool hold_drops) {
  for (const int i : findings.left_piece) move(model, state, hold_drops, state.pieces[at(i)]);
  if (!findings.left_touch.empty()) change_touches(model, findings, state);
  return !findings.left_piece.empty() || !findings.left_touch.empty();
}

bool holds_a_drop(const JointModel& model, const State& state) {
  return std::any_of(state.pieces.begin(), state.pieces.end(), [&](const LigamentPiece& piece) {
    return piece.held && breaks_of(model, piece)[at(piece.piece)].force_jump() < 0;
  });
}

std::string dropped_force(const JointModel& model, const Findings& findings, const State& state) {
  for (const int i : findings.left_piece) {
    const LigamentPiece& piece = state.pieces[at(i)];
    const int passed = break_passed(model, state, piece);
    if (piece.held || !breaks_of(model, piece)[at(passed)].jumps()) continue;
    if (breaks_of(model, piece)[at(passed)].force_jump() < 0) return describe_break(model, piece.ligament, passed);
  }
  return {};
}

bool let_go(const JointModel& model, State& state) {
  bool any = false;
  for (LigamentPiece& piece : state.pieces) {
    if (!piece.held) continue;
    piece.held = false;
    piece.piece += length_of(model, state, piece) > breaks_of(model, piece)[at(piece.piece)].length;
    any = true;
  }
  return any;
}

std::string piece_in_doubt(const JointModel& model, const State& state) {
  std::string out;
  double nearest = kNearestBreak;
  for (const LigamentPiece& piece : state.pieces) {
    const auto& breaks = breaks_of(model, piece);
    const double length = length_of(model, state, piece);
    for (std::size_t k = 0; k < breaks.size(); ++k) {
      const double away = std::abs(length / breaks[k].length - 1);
      if (!breaks[k].jumps() || away >= nearest) continue;
      nearest = away;
      out = describe_break(model, piece.ligament, static_cast<int>(k));
    }
  }
  return out;
}

std::vector<std::pair<PathEvent::Kind, std::string>> touch_events(const JointModel& model, const State& before,
                                                                  const State& after) {
  std::vector<std::pair<PathEvent::Kind, std::string>> out;
  if (before.wraps.size() != after.wraps.size() || after.wraps.empty()) return out;
  for_each_path(model, [&](const LigamentPath& path, const std::string& name) {
    for (std::size_t i = 0; i < path.obstacles().size(); ++i) {
      const std::size_t k = path.touch_index(i);
      const WrapTouch &from = before.wraps[k], &to = after.wraps[k];
      const bool both = from.touching && to.touching;
      if (both && from.arc.begin.n.dot(to.arc.begin.n) < 0 && from.arc.end.n.dot(to.arc.end.n) < 0)
        out.emplace_back(PathEvent::Kind::wrap_side, name + " " + path.obstacles()[i].name);
      if (from.touching == to.touching) continue;
      out.emplace_back(after.wraps[k].touching ? PathEvent::Kind::wraps : PathEvent::Kind::unwraps,
                       name + " " + path.obstacles()[i].name);
    }
  });
  return out;
}

std::vector<std::pair<PathEvent::Kind, std::string>> piece_events(const JointModel& model, const State& before,
                                                                  const State& after) {
  std::vector<std::pair<PathEvent::Kind, std::string>> out;
  for (std::size_t i = 0; i < before.pieces.size() && i < after.pieces.size(); ++i) {
    const LigamentPiece &from = before.pieces[i], &to = after.pieces[i];
    if (from.piece == to.piece && from.held == to.held) continue;
    const auto& breaks = breaks_of(model, to);
    const std::string& name = model.ligaments[at(to.ligament)].name;
    if (to.held) {
      out.emplace_back(PathEvent::Kind::held, describe_break(model, to.ligament, to.piece));
      continue;
    }
    const auto say = [&](int k, bool up) {
      const std::string what = breaks[at(k)].jumps() ? describe_break(model, to.ligament, k) : name;
      out.emplace_back(passed(breaks[at(k)], up), what);
    };
    if (from.held && from.piece == to.piece) say(to.piece, false);
    for (int k = from.piece; k < to.piece; ++k) say(k, true);
    for (int k = from.piece; k > to.piece; --k) say(k - 1, false);
  }
  for (auto& event : touch_events(model, before, after)) out.push_back(std::move(event));
  return out;
}

}  // namespace genu
