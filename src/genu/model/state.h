// What a pose is: where the bodies are, which contacts carry load, and the forces that hold it.
#pragma once

#include <vector>

#include "genu/contact/contact_equations.h"
#include "genu/model/joint_model.h"

namespace genu {

/// A contact that is held closed: one of the N in 6B + M + 5N.
struct ActiveContact {
  int pair = 0;    ///< index into JointModel::pairs
  int number = 0;  ///< of the pair, from 1, by first appearance in the run
  ContactGeometry geometry;
  double force = 0;  ///< N, normal, positive in compression
};

struct State {
  std::vector<Pose> poses;               ///< X_W of every body
  std::vector<JointValues> coordinates;  ///< of every joint, continuous along the path
  std::vector<double> multipliers;       ///< of every prescribed coordinate: N or N m, positive drives it up
  std::vector<ActiveContact> contacts;
};

/// What is asked of a pose: prescribed coordinates, load factors and time at one point of the path.
struct Target {
  struct Prescribed {
    CoordinateRef coordinate;
    double value = 0;  ///< rad or m
  };
  std::vector<Prescribed> prescribed;
  std::vector<double> load_factors;  ///< one for each load
  double time = 0;                   ///< s: only loads scaled over time see it
};

/// The state with every joint at its reference coordinates, nothing in contact, no forces.
inline State reference_state(const JointModel& model) {
  State state;
  state.poses = model.reference_poses;
  for (const auto& joint : model.joints) state.coordinates.push_back(joint.reference);
  return state;
}

}  // namespace genu
