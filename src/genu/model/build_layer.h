// Builds the elastic layers of a model from their definitions in the scene.
#pragma once

#include <memory>

#include "genu/model/joint_model.h"

namespace genu {

/// Builds model.layers[k] from its two surfaces. Meshes keep their own triangles. Shapes with a formula are
/// triangulated with edges of 1/100 of the smaller surface, or 1/50 where smooth surfaces are integrated. False, with
/// the reason in `out`, where a thickness is to be measured and there is no bone. A warning in `out` names the places
/// where bone is missing or protrudes.
bool build_layer(const Scene& scene, const Bones& bones, JointModel& model, std::size_t k, Diagnostics& out);

}  // namespace genu
