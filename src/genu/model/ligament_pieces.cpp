#include "genu/model/ligament_pieces.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace genu {

LigamentShown show_ligament(const JointModel& model, const State& state, int ligament) {
  const auto& l = model.ligaments[at(ligament)];
  const LigamentLaw& law = l.law;
  LigamentShown out;
  out.length = l.path.length(state.poses, state.wraps);
  out.strain = law.strain(out.length);
  for (std::size_t i = 0; i < l.path.obstacles().size(); ++i) out.arcs += l.path.arc_length(state.wraps, i);
  const auto piece = std::find_if(state.pieces.begin(), state.pieces.end(),
                                  [&](const LigamentPiece& p) { return p.ligament == ligament; });
  if (piece == state.pieces.end() || piece->by_length)
    out.force = law.evaluate(out.length).force;
  else
    out.force = piece->held ? piece->force : law.evaluate(out.length, piece->piece).force;
  return out;
}

bool jumps(const LigamentLaw& law) {
  return std::any_of(law.breaks().begin(), law.breaks().end(), [](const LawBreak& b) { return b.jumps(); });
}

bool follow_wraps(const JointModel& model, State& state) {
  if (state.wraps.empty()) return true;
  bool good = true;
  for_each_path(model, [&](const LigamentPath& path, const std::string&) {
    good = good && (path.obstacles().empty() || path.follow_touches(state.poses, state.wraps));
  });
  return good;
}

void settle_wraps(const JointModel& model, State& state) {
  if (model.reference_wraps.empty()) return;
  if (state.wraps.size() != model.reference_wraps.size()) state.wraps = model.reference_wraps;
  for (WrapTouch& touch : state.wraps) touch.by_length = true;
  for_each_path(model, [&](const LigamentPath& path, const std::string&) {
    if (path.obstacles().empty()) return;
    const Wraps before = state.wraps;
    if (path.follow_touches(state.poses, state.wraps)) return;
    state.wraps = before;
    if (path.find_touches(state.poses, state.wraps)) return;
    WrapTouch& lost = state.wraps[path.touch_index(0)];
    lost.touching = true;
    lost.arc.length = std::numeric_limits<double>::quiet_NaN();
  });
  for (WrapTouch& touch : state.wraps) touch.by_length = false;
}

void reset_pieces(const JointModel& model, State& state) {
  settle_wraps(model, state);
  state.pieces.clear();
  for (std::size_t i = 0; i < model.ligaments.size(); ++i) {
    const auto& l = model.ligaments[i];
    if (l.law.sharp_breaks().empty()) continue;
    LigamentPiece piece;
    piece.ligament = static_cast<int>(i);
    piece.piece = l.law.piece_at(l.path.length(state.poses, state.wraps));
    state.pieces.push_back(piece);
  }
}

void follow_lengths(const JointModel& model, State& state) {
  for (LigamentPiece& piece : state.pieces) piece.by_length = !jumps(model.ligaments[at(piece.ligament)].law);
  settle_wraps(model, state);
  for (WrapTouch& touch : state.wraps) touch.by_length = true;
}

bool fix_pieces(const JointModel& model, State& state) {
  bool any = false;
  for (LigamentPiece& piece : state.pieces) {
    if (!piece.by_length) continue;
    const auto& l = model.ligaments[at(piece.ligament)];
    piece.piece = l.law.piece_at(l.path.length(state.poses, state.wraps));
    piece.by_length = false;
    any = true;
  }
  for (WrapTouch& touch : state.wraps) {
    any = any || touch.by_length;
    touch.by_length = false;
  }
  return any;
}

std::string describe_break(const JointModel& model, int ligament, int law_break) {
  const auto& l = model.ligaments[at(ligament)];
  const LawBreak& b = l.law.sharp_breaks()[at(law_break)];
  return fmt::format("{} at {:.9g} mm, {:.9g} N below and {:.9g} N above", l.name, 1e3 * b.length, b.below.force,
                     b.above.force);
}

State reference_state(const JointModel& model) {
  State state;
  state.poses = model.reference_poses;
  for (const auto& joint : model.joints) state.coordinates.push_back(joint.reference);
  state.wraps = model.reference_wraps;
  reset_pieces(model, state);
  return state;
}

State start_state(const JointModel& model) {
  State state;
  for (const auto& joint : model.joints) state.coordinates.push_back(joint.start);
  state.poses = poses_from_coordinates(model, state.coordinates);
  reset_pieces(model, state);
  return state;
}

bool fits_model(const JointModel& model, const State& state) {
  const auto of_pair = [&](const ActiveContact& c) { return c.pair >= 0 && at(c.pair) < model.pairs.size(); };
  const auto of_ligament = [&](const LigamentPiece& p) {
    return p.ligament >= 0 && at(p.ligament) < model.ligaments.size() && p.piece >= 0 &&
           at(p.piece) + (p.held ? 1 : 0) <= model.ligaments[at(p.ligament)].law.sharp_breaks().size();
  };
  return state.poses.size() == model.bodies.size() && state.wraps.size() == model.reference_wraps.size() &&
         state.coordinates.size() == model.joints.size() &&
         std::all_of(state.contacts.begin(), state.contacts.end(), of_pair) &&
         std::all_of(state.pieces.begin(), state.pieces.end(), of_ligament);
}

int held_count(const State& state) {
  int count = 0;
  for (const LigamentPiece& piece : state.pieces) count += piece.held;
  return count;
}

}  // namespace genu
