// From what a scene says about an elastic layer to the sums that a solver asks for.
#pragma once

#include <memory>

#include "genu/model/joint_model.h"

namespace genu {

/// The layer of `def` between the surfaces of `between` (whose own layer is not there yet). Meshes are used as they
/// are; shapes with a formula as triangles whose edges are 1/100 of the smaller of both surfaces.
std::shared_ptr<const ElasticLayer> build_layer(const JointModel& model, const LayerDef& def,
                                                const JointModel::Layer& between);

}  // namespace genu
