// The experiment of Guess et al. (2010) with meshes/smith2019: the flexion of a knee that ligaments, menisci and
// muscles hold while a force on the tibia drives it, beside that of the hinges of Leskovar et al. (2019), driven by a
// torque.
#pragma once

#include <optional>
#include <string>

#include "studies/driven_curve.h"
#include "studies/solved_scene.h"

namespace genu::studies {

struct MenisciStudy {
  /// Over the cycle.
  struct Range {
    double least = 0, most = 0;
  };
  DrivenCurve knee, hinges;                 ///< at the same times
  bool stable = false;                      ///< every pose of the knee is solved, certified and stable
  Range medial, lateral;                    ///< mm: how far forward each meniscus lies on the tibia
  Range share_of_medial, share_of_lateral;  ///< of the force in its compartment
  Range contact;                            ///< N: force between femur and tibia with menisci
};

/// From `knee`/scene-driven.toml, which needs the measured meshes, and `hinges`/scene.toml.
std::optional<MenisciStudy> solve_menisci(const std::string& knee, const std::string& hinges, Diagnostics& out);

/// DRIVEN.md and driven.svg.
Files menisci_files(const MenisciStudy& study);

}  // namespace genu::studies
