// The bones under surfaces whose thickness is measured.
#pragma once

#include "genu/mesh_files/mesh_reader.h"
#include "genu/model/joint_model.h"

namespace genu {

/// Reads them, in the frames of their bodies. What cannot be read is an error in `out`, and null.
Bones read_bones(const PlacedScene& scene, MeshLibrary& meshes, Diagnostics& out);

}  // namespace genu
