// Ligaments of a state: output values, and the pieces of their laws.
#pragma once

#include <string>

#include "genu/model/state.h"

namespace genu {

/// Output values of a ligament.
struct LigamentShown {
  double length = 0;  ///< m
  double strain = 0;  ///< NaN where the law has none
  double force = 0;   ///< N, positive in tension
};
LigamentShown show_ligament(const JointModel& model, const State& state, int ligament);

/// Whether a ligament's law has a break with a jump of force.
bool jumps(const LigamentLaw& law);

/// Puts every ligament whose law has sharp breaks on the piece of its length; none is held.
void reset_pieces(const JointModel& model, State& state);

/// Lets laws without jumps follow their lengths during a search from far.
void follow_lengths(const JointModel& model, State& state);

/// Ends follow_lengths(): every such ligament stays on its current piece. True if there were any.
bool fix_pieces(const JointModel& model, State& state);

/// "AAC at 21.2 mm, 6.3 N below and 9.1 N above": describes a sharp break.
std::string describe_break(const JointModel& model, int ligament, int law_break);

}  // namespace genu
