// Ligaments as a state has them: what is shown of them, and the pieces of their laws they are on.
#pragma once

#include <string>

#include "genu/model/state.h"

namespace genu {

/// What the results show of a ligament.
struct LigamentShown {
  double length = 0;  ///< m
  double strain = 0;  ///< NaN where the law has none
  double force = 0;   ///< N, positive in tension
};
LigamentShown show_ligament(const JointModel& model, const State& state, int ligament);

/// Whether the law of a ligament has a break at which its force jumps.
bool jumps(const LigamentLaw& law);

/// Puts every ligament whose law has sharp breaks on the piece its length lies in; nothing is held.
void reset_pieces(const JointModel& model, State& state);

/// Lets the laws without jumps follow their lengths while a pose is searched from far.
void follow_lengths(const JointModel& model, State& state);

/// Ends follow_lengths(): every such ligament keeps to the piece it is on now. Returns whether there were any.
bool fix_pieces(const JointModel& model, State& state);

/// "AAC at 21.2 mm, 6.3 N below and 9.1 N above": a sharp break in words.
std::string describe_break(const JointModel& model, int ligament, int law_break);

}  // namespace genu
