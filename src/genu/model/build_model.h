// Builds the model of a joint from its scene and surfaces.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/model/build_layer.h"
#include "genu/model/joint_model.h"

namespace genu {

/// Builds the model of a scene. `surfaces`: one for each of Scene::surfaces. `bones`: the bone under each surface whose
/// thickness is measured (null for others; may be empty where none is). `before`: its elastic layers are shared where
/// they would come out the same. Empty result, with errors in `out`, where a law of the scene is impossible. Warnings
/// on thicknesses go to `out` too.
[[nodiscard]] std::optional<JointModel> build_model(const PlacedScene& scene,
                                                    const std::vector<std::shared_ptr<const Surface>>& surfaces,
                                                    Diagnostics& out, const Bones& bones = {},
                                                    const BuiltBefore& before = {});

/// Adds a ligament, for instance with a custom law (LigamentLaw::custom), and updates the scales. Bodies are indices
/// into JointModel::bodies. Call it before any State of the model exists.
void add_ligament(JointModel& model, JointModel::Ligament ligament);

}  // namespace genu
