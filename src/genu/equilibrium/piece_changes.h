// Ligaments that leave the piece of their law they are on: found at a converged pose, changed in the search for one.
//
// While Newton runs every ligament keeps to one piece, continued straight beyond sharp breaks, so that it never sees a
// kink or a jump. (Breaks where force and stiffness are continuous concern no solve; see law_events.h.) What it finds
// must then be consistent: each length on its piece, and the force of a ligament held at a jump between those of the
// two sides (Filippov's set-valued law). It is the search for the contact set once more.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/equilibrium/contact_inspection.h"
#include "genu/equilibrium/path_event.h"
#include "genu/model/ligament_pieces.h"

namespace genu {

/// Adds to `out` the ligaments that are not where their piece is.
void inspect_pieces(const JointModel& model, const State& state, Findings& out);

/// Moves each ligament found to the next state of its law: over a kink or a drop of the force to the other side, at a
/// rise first to the break itself, and from there to the side whose force is passed; with `hold_drops` so at a drop
/// too. False where there is none to move.
bool change_pieces(const JointModel& model, const Findings& findings, State& state, bool hold_drops = false);

/// Whether a ligament is held at a break where its force drops: balanced, but never stable.
bool holds_a_drop(const JointModel& model, const State& state);

/// The first of the ligaments found whose break is a drop of the force with its length, in words; empty if there is
/// none. Beyond it, either way, the joint is out of balance by the whole drop and moves on.
std::string dropped_force(const JointModel& model, const Findings& findings, const State& state);

/// Puts ligaments that cannot be held, since what is prescribed fixes their length already, on the side their length is
/// at. False where none is held.
bool let_go(const JointModel& model, State& state);

/// The break at which some ligament's force jumps and whose length it is nearest to within a hundredth, in words.
std::string piece_in_doubt(const JointModel& model, const State& state);

/// The event of a ligament that has passed a break, up or down.
PathEvent::Kind passed(const LawBreak& b, bool up);

/// What an observer is told of the way from one state to the next.
std::vector<std::pair<PathEvent::Kind, std::string>> piece_events(const JointModel& model, const State& before,
                                                                  const State& after);

}  // namespace genu
