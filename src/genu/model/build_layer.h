// From what a scene says about an elastic layer to the sums that a solver asks for.
#pragma once

#include <memory>

#include "genu/model/joint_model.h"

namespace genu {

/// Another model of the same surfaces and bones, and the scene it was built from.
struct BuiltBefore {
  const PlacedScene* scene = nullptr;
  const JointModel* model = nullptr;
};

/// Gives model.layers[k] its layer, whose surfaces it has. Meshes are cut into the triangles they have; shapes with a
/// formula into triangles whose edges are 1/100 of the smaller of both surfaces, or 1/50 where the sum is over smooth
/// surfaces. False, with the reason in `out`, where a thickness is to be measured and there is no bone; where bone is
/// missing or stands out in places, a warning in `out` says where.
bool build_layer(const PlacedScene& scene, const Bones& bones, JointModel& model, std::size_t k, Diagnostics& out);

/// Takes the layer from `before` where it would be built the same: the definition, the surfaces, and where closed forms
/// are cut round the joint. False where there is none or it would differ.
bool share_layer(const PlacedScene& scene, const BuiltBefore& before, JointModel& model, std::size_t k);

}  // namespace genu
