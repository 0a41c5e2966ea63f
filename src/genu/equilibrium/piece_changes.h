// Changes of the piece of a law that a ligament is on: detected at a converged pose, made in the search for one.
//
// During Newton's method every ligament keeps to one piece, extended beyond its sharp breaks, so that the residual is
// smooth. (Breaks with continuous force and stiffness matter to no solve; see law_events.h.) The result must be
// consistent: each length lies on its piece, and the force of a ligament held at a jump lies between those of the two
// sides (Filippov's set-valued law). This is an active-set search over pieces.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/equilibrium/contact_inspection.h"
#include "genu/equilibrium/path_event.h"
#include "genu/model/ligament_pieces.h"

namespace genu {

/// Adds to `out` the ligaments that are off their piece.
void inspect_pieces(const JointModel& model, const State& state, Findings& out);

/// Distance of the only ligament or touch in `findings` (only_left_piece()) from its change at another state of the
/// same pieces and touches, scaled; negative beyond it. findings.worst is that at the state they belong to.
double margin_of_change(const JointModel& model, const Findings& findings, const State& state);

/// Moves each ligament found to the next state of its law. Across a change of stiffness or a drop of the force it goes
/// to the other side. At a rise of the force it goes first to the break, and from there to the side whose force it
/// exceeds; with `hold_drops` the same holds at a drop. False where there is none to move.
bool change_pieces(const JointModel& model, const Findings& findings, State& state, bool hold_drops = false);

/// Whether a ligament is held at a break where its force drops. Such a pose is balanced and never stable.
bool holds_a_drop(const JointModel& model, const State& state);

/// Describes the first ligament found whose force drops at a break; empty if there is none. On both sides of it the
/// joint is out of balance by the whole drop and moves on.
std::string dropped_force(const JointModel& model, const Findings& findings, const State& state);

/// Releases held ligaments whose length the prescribed coordinates already fix, to the side of their length. False
/// where none is held.
bool let_go(const JointModel& model, State& state);

/// Describes the jump of force whose length is nearest to a ligament's, within 1 percent; empty if there is none.
std::string piece_in_doubt(const JointModel& model, const State& state);

/// The path that is about to slip off its surfaces, with their names; empty if none is. No path of this side is found
/// a little farther on.
std::string path_about_to_slip(const JointModel& model, const State& state);

/// The event of a ligament that passes a break, up or down.
PathEvent::Kind passed(const LawBreak& b, bool up);

/// Events of paths that begin to touch surfaces or leave them, from one state to the next.
std::vector<std::pair<PathEvent::Kind, std::string>> touch_events(const JointModel& model, const State& before,
                                                                  const State& after);

/// Events of ligaments from one state to the next, touches included.
std::vector<std::pair<PathEvent::Kind, std::string>> piece_events(const JointModel& model, const State& before,
                                                                  const State& after);

}  // namespace genu
