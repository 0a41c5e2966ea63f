// Laxity at held flexion: the tibia of meshes/wismans1980 pulled forth and back by a drawer force, and turned in and
// out by a moment, at several angles of flexion: displacement against force, rotation against moment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/solved_scene.h"

namespace genu::studies {

/// One load at one angle of flexion: from 0 to the largest, to its negative and back to 0. Motions are since no load.
struct LaxityTest {
  double flexion = 0;                   ///< deg
  std::vector<double> load;             ///< on the tibia: N forward, or N m inward
  std::vector<double> displacement;     ///< mm, of the tibia on the femur forward along the tibia's own axis
  std::vector<double> rotation;         ///< deg, of the tibia inward
  std::vector<double> medial, lateral;  ///< N, contact forces
  std::vector<int> contacts;            ///< points

  /// Displacement and rotation at a load that was stopped at, on the way from the largest load to its negative.
  double displacement_at(double value) const;
  double rotation_at(double value) const;
  /// Largest difference between motions at the same load on different ways, mm and deg.
  double hysteresis() const;
  /// dF/du by central differences on the way from the largest load to its negative, N/mm.
  double stiffness_at(double force_N) const;
};

struct LaxityStudy {
  std::vector<LaxityTest> drawers, twists;  ///< by flexion
  double force = 0, moment = 0;             ///< the largest, N and N m
  bool all_stable = false;
  int poses = 0;
  std::vector<int> poses_of;  ///< by the number of contact points
};

/// The scene's steps come in sevens: to an angle of flexion, then its load `drawer` by the factors 0 to 1, to -1, to 0,
/// then `torsion`. Empty, with an error in `out`, where it is refused or is no such scene.
std::optional<LaxityStudy> solve_laxity(const std::string& file, Diagnostics& out);

/// STUDY.md and the charts.
Files laxity_files(const LaxityStudy& study);

}  // namespace genu::studies
