// Ligaments as a state has them: their lengths from point to point, and the pieces of their laws they are on.
#pragma once

#include <string>

#include "genu/model/state.h"

namespace genu {

/// Calls f(body_a, body_b, line) for every straight line of a ligament, from end to end.
template <typename F>
void for_each_line(const JointModel::LigamentBetween& l, const F& f) {
  int body = l.body_a;
  Vec3 p = l.ligament.p_A;
  for (const auto& via : l.via) {
    f(body, via.body, TautLine{p, via.p});
    body = via.body;
    p = via.p;
  }
  f(body, l.body_b, TautLine{p, l.ligament.p_B});
}

/// m, over all via points; `poses` of every body in the world.
double ligament_length(const JointModel::LigamentBetween& l, const std::vector<Pose>& poses);

/// How fast it grows (m per unit of what `twist`, 6 for each moving body, is a rate in).
double ligament_length_rate(const JointModel& model, const JointModel::LigamentBetween& l,
                            const std::vector<Pose>& poses, const VecX& twist);

/// Its derivative to the twists, 6B.
VecX ligament_length_gradient(const JointModel& model, const JointModel::LigamentBetween& l,
                              const std::vector<Pose>& poses);

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
