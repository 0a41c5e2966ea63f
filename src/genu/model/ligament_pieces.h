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
  double arcs = 0;    ///< m: the part of the length along surfaces
};
LigamentShown show_ligament(const JointModel& model, const State& state, int ligament);

/// Whether a ligament's law has a break with a jump of force.
bool jumps(const LigamentLaw& law);

/// Puts every ligament whose law has sharp breaks on the piece of its length; none is held. Settles wraps.
void reset_pieces(const JointModel& model, State& state);

/// Calls f(path, name) for the path of every ligament and cable, in the order of State::wraps.
template <typename F>
void for_each_path(const JointModel& model, const F& f) {
  for (const auto& l : model.ligaments) f(l.path, l.name);
  for (const Load& load : model.loads)
    if (load.kind == Load::Kind::cable) f(load.path, load.name);
}

/// Carries the touches of paths on to the poses of `state`. False where a path is not found.
[[nodiscard]] bool follow_wraps(const JointModel& model, State& state);

/// The same from any state: touching and free follow from the lengths, and what cannot be carried on is sought anew.
/// The length of a path that is not found is not finite.
void settle_wraps(const JointModel& model, State& state);

/// Lets laws without jumps, and wraps, follow their lengths during a search from far.
void follow_lengths(const JointModel& model, State& state);

/// Ends follow_lengths(): every such ligament stays on its current piece. True if there were any.
bool fix_pieces(const JointModel& model, State& state);

/// "AAC at 21.2 mm, 6.3 N below and 9.1 N above": describes a sharp break.
std::string describe_break(const JointModel& model, int ligament, int law_break);

}  // namespace genu
