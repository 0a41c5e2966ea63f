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

/// A ligament whose law has breaks, and the piece of the law it is on.
struct LigamentPiece {
  int ligament = 0;  ///< index into JointModel::ligaments
  int piece = 0;     ///< 0 up to the first break
  /// Where the force jumps up, between the pieces `piece` and `piece` + 1: the ligament keeps the break's length and
  /// has any force between the two sides' (one more constraint, whose multiplier is `force`).
  bool held = false;
  bool by_length = false;  ///< the law is evaluated as it is, whichever piece the length lies in
  double force = 0;        ///< N, of a held one
};

struct State {
  std::vector<Pose> poses;               ///< X_W of every body
  std::vector<JointValues> coordinates;  ///< of every joint, continuous along the path
  std::vector<double> multipliers;       ///< of every prescribed coordinate: N or N m, positive drives it up
  std::vector<ActiveContact> contacts;
  std::vector<LigamentPiece> pieces;  ///< of every ligament whose law has breaks, in the model's order
};

/// What is asked of a pose: prescribed coordinates and load factors at one point of the path.
struct Target {
  struct Prescribed {
    CoordinateRef coordinate;
    double value = 0;  ///< rad or m
  };
  std::vector<Prescribed> prescribed;
  std::vector<double> load_factors;  ///< one for each load
};

/// The state with every joint at its reference coordinates, nothing in contact, no forces.
State reference_state(const JointModel& model);

/// The constraints beside the prescribed coordinates: ligaments held at a break.
int held_count(const State& state);

}  // namespace genu
