// A picture of the bones of meshes/leskovar2019, from the shapes that `genu mesh` makes them of.
#pragma once

#include "genu/core/diagnostics.h"
#include "studies/dortmans_study.h"

namespace genu::studies {

/// bones.svg: from the front and from the outer side, in the pose of angle 0; bones-flexed.svg: where the torque of
/// scene-bones.toml flexes the tibia most.
Files bones_files(const std::string& folder, Diagnostics& problems);

}  // namespace genu::studies
