// How a ligament changes with the numbers that describe it, at bodies held still: the derivatives of ligament_law.h and
// ligament.h to their parameters.
//
// With the length L, the slack length L0 and the other numbers k of the law, the force F(L; L0, k) changes by
//   dF = F' dL + dF/dL0 dL0 + dF/dk dk,
// and L0 itself follows from the length L_r in the reference pose: L_r / (1 + e_r) for a reference strain e_r;
// implicitly from F(L_r; L0, k) = F_r for a reference force, so that dF/dL0 dL0 = dF_r - F'(L_r) dL_r - dF/dk(L_r) dk.
// A ligament's end moves L and, through the reference pose, L0.
#pragma once

#include "genu/model/ligament_pieces.h"
#include "genu/model/parameters.h"

namespace genu {

/// Per SI unit of a parameter. Where the ligament is slack everything but length and strain is 0.
struct LigamentRate {
  struct Line {
    int body_a, body_b;
    Vec12 wrench;  ///< on [a; b] as in TwoBodyWrench
  };
  std::vector<Line> lines;  ///< from end to end
  double length = 0, strain = 0, force = 0;
};

/// A ligament of a scene: what it is said to be, what was made of it, and the poses of all bodies.
struct LigamentAt {
  const LigamentDef& def;
  const JointModel::Ligament& made;
  const std::vector<Pose>&reference_poses, &poses;
};

/// The change of a ligament per SI unit of one of its own parameters. A slack length that has no derivative (a
/// reference force of 0 in a law that is flat there) gives NaN.
LigamentRate ligament_rate(const LigamentAt& at, const Parameter& parameter);

}  // namespace genu
