// A change of all unknowns of a pose, and the state after it.
#pragma once

#include <vector>

#include "genu/model/state.h"

namespace genu {

/// A change of the unknowns.
struct Correction {
  VecX twist;                 ///< 6B
  VecX multipliers;           ///< M + H
  std::vector<Vec4> surface;  ///< ds_A, ds_B of each contact
  VecX forces;                ///< N
  double parameter = 0;       ///< of the path's parameter, where that is an unknown (arc-length control)

  void resize(int moving_bodies, int constraints, int contacts);
  /// Whether both have the same unknowns.
  bool matches(const Correction& other) const;
  /// Adds `factor` times a correction that matches.
  void add(double factor, const Correction& other);
  void scale(double factor);
};

/// The state after `fraction` of a correction: poses on SE(3), contact points on their surfaces. False, with `out`
/// unspecified, where a contact point would leave the known part of its surface.
[[nodiscard]] bool retract(const JointModel& model, const State& state, const Correction& correction, double fraction,
                           State& out);

/// Updates the coordinates of every joint from the poses, continuous with their last values.
void update_coordinates(const JointModel& model, State& state);

}  // namespace genu
