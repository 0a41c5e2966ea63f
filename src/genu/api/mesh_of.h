// Triangles of the API as a mesh of the rooms below. Not installed.
#pragma once

#include <string>

#include "genu/api/meshes.h"
#include "genu/mesh/mesh.h"

namespace genu::api {

/// In the unit that it is given in. Throws SceneError, which names `name`, for one that has no triangles or vertices
/// that are none.
Mesh mesh_of(const std::string& name, const Triangles& given);

}  // namespace genu::api
