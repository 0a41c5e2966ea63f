// Mass, centre of mass and inertia of the bodies that are closed meshes full of a material.
#pragma once

#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/results/summary.h"
#include "genu/scene/scene.h"

namespace genu {

/// Reads the mesh of each body that has a `solid` and puts what follows from it into the body. A mesh that bounds no
/// volume (open, torn, one-sided, flat) is an error in `out` at the key that names it; one that faces inward is taken
/// the other way round with a warning.
[[nodiscard]] std::vector<RunSummary::BodyFacts> read_solids(Scene& scene, MeshLibrary& meshes, Diagnostics& out);

}  // namespace genu
