// The state of a pose: positions of the bodies, active contacts, and forces.
#pragma once

#include <algorithm>
#include <vector>

#include "genu/contact/contact_equations.h"
#include "genu/model/joint_model.h"

namespace genu {

/// An active (closed) contact: one of the N in 6B + M + 5N.
struct ActiveContact {
  int pair = 0;    ///< index into JointModel::pairs
  int number = 0;  ///< of the pair, from 1, by first appearance in the run
  ContactGeometry geometry;
  double force = 0;  ///< N, normal, positive in compression
};

/// A ligament whose law has sharp breaks (ligament_law.h), and the piece of the law it is on.
struct LigamentPiece {
  int ligament = 0;  ///< index into JointModel::ligaments
  int piece = 0;     ///< 0 up to the first sharp break
  /// At an upward jump of force, between the pieces `piece` and `piece` + 1: the ligament keeps the break's length,
  /// with any force between the two sides' (one more constraint, whose multiplier is `force`).
  bool held = false;
  bool by_length = false;  ///< the law is evaluated on whichever piece contains the length
  double force = 0;        ///< N, of a held one
};

struct State {
  std::vector<Pose> poses;               ///< X_W of every body
  std::vector<JointValues> coordinates;  ///< of every joint, continuous along the path
  std::vector<double> multipliers;       ///< N or N m, positive drives the coordinate up: of prescribed
                                         ///< quantities, then of coordinates held by joints. Factors of loads where
                                         ///< loads drive a prescribed quantity
  std::vector<ActiveContact> contacts;
  std::vector<LigamentPiece> pieces;  ///< of every ligament whose law has sharp breaks, in the model's order
  Wraps wraps;                        ///< of every obstacle of a path, in the model's order; at these poses
  std::vector<int> layer_levels;      ///< refinement level of each elastic layer (LayerQuadrature); empty: all 0

  int layer_level(std::size_t layer) const { return layer < layer_levels.size() ? layer_levels[layer] : 0; }
};

/// Prescribed coordinates (or linear combinations), load factors and time at one point of the path.
struct Target {
  struct Prescribed {
    QuantityRef coordinate;
    double value = 0;  ///< rad or m
    /// Loads that hold the coordinate in the place of a reaction. Its multiplier is their factor.
    std::vector<int> drivers = {};
  };
  std::vector<Prescribed> prescribed;
  std::vector<double> load_factors;  ///< one for each load; 0 of those that drive a coordinate
  double time = 0;                   ///< s: used by loads scaled over time only
};

/// The state with every joint at its reference coordinates, nothing in contact, no forces.
State reference_state(const JointModel& model);

/// The same at the coordinates where the search for equilibrium starts.
State start_state(const JointModel& model);

/// Whether the sizes and indices of a state fit the model.
bool fits_model(const JointModel& model, const State& state);

/// H: ligaments held at a break, which are constraints besides those of constraint_count().
int held_count(const State& state);

/// Whether a contact with that pair and number is active in a state.
inline bool contains(const State& state, const ActiveContact& contact) {
  return std::any_of(state.contacts.begin(), state.contacts.end(),
                     [&](const ActiveContact& c) { return c.pair == contact.pair && c.number == contact.number; });
}

/// Whether two states have the same active set.
inline bool same_contacts(const State& a, const State& b) {
  return a.contacts.size() == b.contacts.size() &&
         std::all_of(a.contacts.begin(), a.contacts.end(), [&](const ActiveContact& c) { return contains(b, c); });
}

/// M: prescribed quantities and coordinates held by joints.
inline std::size_t constraint_count(const JointModel& model, const Target& target) {
  return target.prescribed.size() + model.held.size();
}

/// Whether constraint m is an angle. Constraints after constraint_count() are lengths of held ligaments.
inline bool is_rotation(const JointModel& model, const Target& target, std::size_t m) {
  const std::size_t prescribed = target.prescribed.size();
  if (m >= constraint_count(model, target)) return false;
  return m < prescribed ? target.prescribed[m].coordinate.is_rotation()
                        : model.held[m - prescribed].coordinate.index < 3;
}

/// Whether a load is among those that drive one of these prescribed coordinates.
template <typename Prescribed>
bool drives(const std::vector<Prescribed>& prescribed, std::size_t load) {
  return std::any_of(prescribed.begin(), prescribed.end(), [load](const Prescribed& p) {
    return std::find(p.drivers.begin(), p.drivers.end(), static_cast<int>(load)) != p.drivers.end();
  });
}

/// The factor of a load: the target's, or the one found where the load drives a prescribed coordinate.
inline double load_factor(const Target& target, const State& state, std::size_t load) {
  for (std::size_t m = 0; m < target.prescribed.size() && m < state.multipliers.size(); ++m)
    for (const int driver : target.prescribed[m].drivers)
      if (static_cast<std::size_t>(driver) == load) return state.multipliers[m];
  return target.load_factors[load];
}

/// Gives `state` a multiplier for each constraint of `target`. Coordinates held by joints keep theirs where the number
/// of prescribed coordinates changes. The search for a load's factor starts from 1.
inline void fit_multipliers(const JointModel& model, const Target& target, State& state) {
  const std::size_t prescribed = target.prescribed.size(), held = model.held.size();
  if (state.multipliers.size() < held) state.multipliers.assign(held, 0.0);
  const std::size_t before = state.multipliers.size() - held;
  const auto first_held = state.multipliers.begin() + static_cast<std::ptrdiff_t>(before);
  if (prescribed < before)
    state.multipliers.erase(first_held - static_cast<std::ptrdiff_t>(before - prescribed), first_held);
  else
    for (std::size_t m = before; m < prescribed; ++m)
      state.multipliers.insert(state.multipliers.begin() + static_cast<std::ptrdiff_t>(m),
                               target.prescribed[m].drivers.empty() ? 0.0 : 1.0);
}

}  // namespace genu
