// Builds the elastic layers of a model from their definitions in the scene.
#pragma once

#include <memory>

#include "genu/model/joint_model.h"

namespace genu {

/// Another model of the same surfaces and bones, and the scene it was built from.
struct BuiltBefore {
  const PlacedScene* scene = nullptr;
  const JointModel* model = nullptr;
};

/// Builds model.layers[k] from its two surfaces. Meshes keep their own triangles. Shapes with a formula are
/// triangulated with edges of 1/100 of the smaller surface, or 1/50 where smooth surfaces are integrated. False, with
/// the reason in `out`, where a thickness is to be measured and there is no bone. A warning in `out` names the places
/// where bone is missing or protrudes.
[[nodiscard]] bool build_layer(const PlacedScene& scene, const Bones& bones, JointModel& model, std::size_t k,
                               Diagnostics& out);

/// Takes the layer from `before` where it would be built the same: the definition, the surfaces, and where closed forms
/// are cut round the joint. False where there is none or it would differ.
bool share_layer(const PlacedScene& scene, const BuiltBefore& before, JointModel& model, std::size_t k);

}  // namespace genu
