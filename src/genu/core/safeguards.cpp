#include "genu/core/safeguards.h"

#include <array>

namespace genu {
namespace {

struct SafeguardFacts {
  const char* name;
  const char* what;
};

constexpr std::size_t kSafeguards = static_cast<std::size_t>(Safeguard::count);

constexpr std::array<SafeguardFacts, kSafeguards> kSafeguardFacts = {{
    {"polish", "where a small residual does not make a small error it is followed further down"},
    {"force_guess", "a first guess of contact forces where the search from none leads nowhere"},
    {"minimum_norm", "steps of least norm where the Jacobian has no full rank"},
    {"monotonicity", "steps are damped until they lead toward the solution"},
    {"step_caps", "no iteration turns a body, or slides a contact, far"},
    {"force_scale", "forces are measured in a force of the scene's own"},
    {"length_scale", "lengths are measured in a length of the scene's own"},
    {"gap_rounding", "far from the world's origin gaps are known to rounding only"},
    {"pulling", "contacts that pull are let go"},
    {"survey", "the whole of every pair is looked at for overlaps"},
    {"merging", "of contacts that have run into each other one goes"},
    {"probes", "twins of a contact about to split are looked for beside it"},
    {"unexplained", "samples that overlap where no minimum says why are seen"},
    {"opposed", "normals at a contact face each other"},
    {"edges", "contact points lie inside their patches"},
    {"rims", "the edges of patches are looked at themselves, between the samples of the other surface"},
    {"contact_limit", "no more contacts than leave a freedom"},
    {"without_one", "of contacts that exclude each other one goes"},
    {"passing", "no body comes to its pose through another"},
    {"seed", "far from contact an elastic foundation leads to it"},
    {"downhill", "and where Newton's method wanders on that, the way down its energy"},
    {"swallowed", "a surface inside another is seen by points of its own"},
    {"far_side", "beyond the band of a smooth mesh its triangles tell the side"},
    {"buried", "layers pressed deeper than their rays look are not taken for free"},
    {"event_location", "what happens between two rows is located on the path"},
    {"branch", "a solution on another branch is not taken"},
    {"uniqueness", "a pose or force that is one of many is said to be one"},
    {"limit_points", "where a path turns back is looked for and told"},
    {"step_over", "a short stretch without rigid solution is passed"},
    {"sharp_breaks", "laws with kinks and jumps are solved piece by piece"},
    {"bifurcations", "branches that part are told"},
    {"closing", "a path that comes back to its start has an end"},
    {"freedom", "prescribed coordinates and contacts leave a freedom"},
    {"flat_pairs", "two planes make no point of contact"},
    {"start_overlap", "deep overlap at the start is refused"},
    {"centring", "bodies are solved from origins amid what they carry"},
    {"flaws", "what is wrong with a mesh is cut out and remembered"},
    {"winding", "triangles wound against the rest are turned round"},
    {"noise", "the noise of a mesh widens its fits"},
    {"scale_doubts", "sizes and roundings that no knee's mesh has are told"},
    {"landing", "contacts that close are located between two steps"},
    {"kinks", "the integration stops where loads and drives have kinks"},
    {"stiffness", "stiff motions are integrated by formulas for them"},
    {"headway", "a motion that comes to no end is ended"},
    {"massless", "what no inertia opposes is refused"},
    {"energy_balance", "energies that do not balance are told"},
}};

static_assert(kSafeguards <= 64, "Safeguards keeps a bit for each");

const SafeguardFacts& facts_of(Safeguard s) { return kSafeguardFacts.at(static_cast<std::size_t>(s)); }

}  // namespace

const char* to_string(Safeguard safeguard) { return facts_of(safeguard).name; }
const char* describe(Safeguard safeguard) { return facts_of(safeguard).what; }

std::optional<Safeguard> safeguard_named(const std::string& name) {
  for (const Safeguard s : all_safeguards())
    if (name == to_string(s)) return s;
  return std::nullopt;
}

std::vector<Safeguard> all_safeguards() {
  std::vector<Safeguard> all;
  for (std::size_t k = 0; k < kSafeguards; ++k) all.push_back(static_cast<Safeguard>(k));
  return all;
}

}  // namespace genu
