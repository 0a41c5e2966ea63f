// From a scene and its surfaces to the model that is solved.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/model/build_layer.h"
#include "genu/model/joint_model.h"

namespace genu {

/// Builds the model of a scene; `surfaces` holds one surface for each of Scene::surfaces, `bones` the bone under each
/// whose thickness is measured (null for others; may be empty where there is none). What the scene's laws cannot be is
/// added to `out`, and the result is empty; so are warnings on thicknesses. The elastic layers of `before` are shared
/// where they would come out the same.
std::optional<JointModel> build_model(const PlacedScene& scene,
                                      const std::vector<std::shared_ptr<const Surface>>& surfaces, Diagnostics& out,
                                      const Bones& bones = {}, const BuiltBefore& before = {});

/// Adds a ligament, for instance with a law of the caller's own (LigamentLaw::custom), and adjusts the scales. Bodies
/// are indices into JointModel::bodies. Only before a State is made of the model.
void add_ligament(JointModel& model, JointModel::Ligament ligament);

}  // namespace genu
