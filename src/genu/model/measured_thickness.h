// The thickness that a scene wants measured on a surface, and what is to be said about it.
#pragma once

#include "genu/contact/bone_thickness.h"
#include "genu/model/joint_model.h"

namespace genu {

/// `field` becomes the thickness measured on the triangles `mesh` of a surface, and stays null where the scene measures
/// none. False, with an error in `out`, where there is no bone under it; warnings on places without bone, and on those
/// where bone stands out or cartilage is thinner than the scene lets it be, each once for a surface.
bool thickness_on(const PlacedScene& scene, const Bones& bones, int surface, const Mesh& mesh,
                  std::shared_ptr<const ThicknessField>& field, Diagnostics& out);

}  // namespace genu
