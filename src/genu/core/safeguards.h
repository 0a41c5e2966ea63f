// What stands between a hard case and a wrong answer, each by its name. A run has all of them. Tests switch one off to
// show that the cases it is there for are then answered wrongly: data that goes with the model, no global state.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace genu {

enum class Safeguard {
  // Newton's method
  polish,        ///< where a small residual does not make a small error it is followed further down
  force_guess,   ///< a first guess of contact forces where the search from none leads nowhere
  minimum_norm,  ///< steps of least norm where the Jacobian has no full rank
  monotonicity,  ///< steps are damped until they lead toward the solution
  step_caps,     ///< no iteration turns a body, or slides a contact, far
  force_scale,   ///< forces are measured in a force of the scene's own
  length_scale,  ///< lengths are measured in a length of the scene's own
  gap_rounding,  ///< far from the world's origin gaps are known to rounding only
  // the set of contacts
  pulling,        ///< contacts that pull are let go
  survey,         ///< the whole of every pair is looked at for overlaps
  merging,        ///< of contacts that have run into each other one goes
  probes,         ///< twins of a contact about to split are looked for beside it
  unexplained,    ///< samples that overlap where no minimum says why
  opposed,        ///< normals at a contact face each other
  edges,          ///< contact points lie inside their patches
  rims,           ///< the edges of patches are looked at themselves, between the samples of the other surface
  contact_limit,  ///< no more contacts than leave a freedom
  without_one,    ///< of contacts that exclude each other one goes
  passing,        ///< no body comes to its pose through another
  seed,           ///< far from contact an elastic foundation leads to it
  downhill,       ///< and where Newton's method wanders on that, the way down its energy
  swallowed,      ///< a surface inside another is seen by points of its own
  far_side,       ///< beyond the band of a smooth mesh its triangles tell the side
  buried,         ///< layers pressed deeper than their rays look are no free ones
  // paths
  event_location,  ///< what happens between two rows is located on the path
  branch,          ///< a solution on another branch is not taken
  uniqueness,      ///< a pose or force that is one of many is said to be one
  limit_points,    ///< where a path turns back is looked for and told
  step_over,       ///< a short stretch without rigid solution is passed
  sharp_breaks,    ///< laws with kinks and jumps are solved piece by piece
  bifurcations,    ///< branches that part are told
  closing,         ///< a path that comes back to its start has an end
  // what comes in
  freedom,        ///< prescribed coordinates and contacts leave a freedom
  flat_pairs,     ///< two planes make no point of contact
  start_overlap,  ///< deep overlap at the start is refused
  centring,       ///< bodies are solved from origins amid what they carry
  flaws,          ///< what is wrong with a mesh is cut out and remembered
  winding,        ///< triangles wound against the rest are turned round
  noise,          ///< the noise of a mesh widens its fits
  scale_doubts,   ///< sizes and roundings that no knee's mesh has are told
  // motion
  landing,         ///< contacts that close are located between two steps
  kinks,           ///< the integration stops where loads and drives have kinks
  stiffness,       ///< stiff motions are integrated by formulas for them
  headway,         ///< a motion that comes to no end is ended
  massless,        ///< what no inertia opposes is refused
  energy_balance,  ///< energies that do not balance are told
  count            // not one of them
};

const char* to_string(Safeguard safeguard);
/// What it does, in a few words.
const char* describe(Safeguard safeguard);
std::optional<Safeguard> safeguard_named(const std::string& name);
std::vector<Safeguard> all_safeguards();

class Safeguards {
 public:
  bool has(Safeguard s) const { return (off_ >> static_cast<int>(s) & 1U) == 0; }
  bool lacks(Safeguard s) const { return !has(s); }
  void switch_off(Safeguard s) { off_ |= std::uint64_t{1} << static_cast<int>(s); }
  static Safeguards without(Safeguard s) {
    Safeguards all;
    all.switch_off(s);
    return all;
  }

 private:
  std::uint64_t off_ = 0;
};

}  // namespace genu
