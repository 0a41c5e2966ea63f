// Anterior-posterior laxity at held flexion: meshes/wismans1980 pulled forth and back by a drawer force at several
// angles of flexion, displacement against force.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/solved_scene.h"

namespace genu::studies {

/// The drawer test at one angle of flexion: force from 0 to the largest, to its negative and back to 0.
struct Drawer {
  double flexion = 0;                   ///< deg
  std::vector<double> force;            ///< N, on the tibia, positive forward
  std::vector<double> displacement;     ///< mm, of the tibia on the femur along the tibia's own axis y since no force
  std::vector<double> rotation;         ///< deg, of the tibia inward, since no force
  std::vector<double> medial, lateral;  ///< N, contact forces

  /// The displacement at a force that was stopped at, on the way from the largest force to its negative.
  double at(double force_N) const;
  /// Largest difference between displacements at the same force on different ways, mm.
  double hysteresis() const;
  /// dF/du by central differences on the way from the largest force to its negative, N/mm.
  double stiffness_at(double force_N) const;
};

struct LaxityStudy {
  std::vector<Drawer> drawers;  ///< by flexion
  bool all_stable = false;
  int fewest_contacts = 0;  ///< at any pose
};

/// The scene's steps come in fours: to an angle of flexion, then its load `drawer` by the factors 0 to 1, to -1, to 0.
/// Empty, with an error in `out`, where it is refused or is no such scene.
std::optional<LaxityStudy> solve_laxity(const std::string& file, Diagnostics& out);

/// STUDY.md and the charts.
Files laxity_files(const LaxityStudy& study);

}  // namespace genu::studies
