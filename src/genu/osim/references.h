// What elements of a model name: frames, coordinates and contact meshes. What follows can rely on all of them.
#pragma once

#include "genu/core/diagnostics.h"
#include "genu/osim/model.h"

namespace genu::osim {

/// An error for each name of a frame, coordinate or contact mesh that the model does not have, for two couplers of one
/// coordinate and for couplers that drive each other in a circle.
void check_references(const Model& model, Diagnostics& out);

}  // namespace genu::osim
