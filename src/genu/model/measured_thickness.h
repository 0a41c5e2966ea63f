// The thickness measured on a surface, with warnings.
#pragma once

#include "genu/contact/bone_thickness.h"
#include "genu/model/joint_model.h"

namespace genu {

/// Sets `field` to the thickness measured on the triangles `mesh` of a surface; null where the scene measures none.
/// False, with an error in `out`, where there is no bone under it. Warns once per surface of places without bone, of
/// protruding bone, and of cartilage thinner than the scene allows.
[[nodiscard]] bool thickness_on(const PlacedScene& scene, const Bones& bones, int surface, const Mesh& mesh,
                                std::shared_ptr<const ThicknessField>& field, Diagnostics& out);

}  // namespace genu
