// Sensitivity of a ligament to its own parameters at fixed poses: the parameter derivatives of ligament_law.h and
// ligament.h.
//
// With length L, slack length L0 and the other numbers k of the law,
//
//   dF = F' dL + dF/dL0 dL0 + dF/dk dk.
//
// L0 follows from the length L_r in the reference pose: L_r / (1 + e_r) for a reference strain e_r; implicitly from
// F(L_r; L0, k) = F_r for a reference force, so that dF/dL0 dL0 = dF_r - F'(L_r) dL_r - dF/dk(L_r) dk. A moved end
// changes L and, through the reference pose, L0.
#pragma once

#include "genu/model/ligament_pieces.h"
#include "genu/model/parameters.h"

namespace genu {

/// Per SI unit of a parameter. Where the ligament is slack all but length and strain is 0.
struct LigamentRate {
  VecX wrench;  ///< 6 for each moving body; empty where it is 0
  double length = 0, strain = 0, force = 0;
};

/// A ligament of a scene: its definition, its model, and the poses of all bodies.
struct LigamentAt {
  const LigamentDef& def;
  const JointModel::Ligament& made;
  const std::vector<Pose>&reference_poses, &poses;
  const Wraps &reference_wraps, &wraps;
  int moving_count = 0;
};

/// Whether a parameter is one of the ligament's own, or of a surface that it wraps round.
bool concerns(const LigamentDef& def, int ligament, const Parameter& parameter);

/// The derivative of a ligament per SI unit of a parameter that concerns it. `surfaces`: of the scene. NaN where the
/// slack length has no derivative (a reference force of 0 in a law that is flat there).
LigamentRate ligament_rate(const LigamentAt& at, const Parameter& parameter, const std::vector<SurfaceDef>& surfaces);

}  // namespace genu
