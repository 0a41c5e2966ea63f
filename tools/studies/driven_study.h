// The experiment of Leskovar et al. 2019 with meshes/leskovar2019: the angle of a knee that ligaments hold, driven by a
// force on the tibia, and that of a hinge whose stiffness and damping are calibrated to it, driven by a torque.
#pragma once

#include <optional>
#include <string>

#include "studies/driven_curve.h"
#include "studies/solved_scene.h"

namespace genu::studies {

struct DrivenStudy {
  DrivenCurve ligaments, hinges;
  double rms = 0;  ///< deg, between both
};

/// From scene-driven.toml and scene-driven-hinges.toml in `folder`.
std::optional<DrivenStudy> solve_driven(const std::string& folder, Diagnostics& out);

/// DRIVEN.md and driven.svg.
Files driven_files(const DrivenStudy& study);

}  // namespace genu::studies
