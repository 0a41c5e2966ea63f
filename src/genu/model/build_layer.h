// From what a scene says about an elastic layer to the sums that a solver asks for.
#pragma once

#include <memory>

#include "genu/model/joint_model.h"

namespace genu {

/// Gives `between` its layer. Meshes are cut into the triangles they have; shapes with a formula into triangles whose
/// edges are 1/100 of the smaller of both surfaces, or 1/50 where the sum is over smooth surfaces.
void build_layer(const JointModel& model, const LayerDef& def, JointModel::Layer& between);

}  // namespace genu
