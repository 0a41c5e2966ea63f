// The fans of triangles round each vertex: where there are two, sheets touch in a single vertex.
#pragma once

#include <cstddef>

#include "genu/mesh/mesh.h"

namespace genu {

/// Gives each fan but the first of its vertex a vertex of its own at the same place, numbered after the others.
/// Returns how many vertices had more than one fan.
std::size_t split_fans(Mesh& mesh);

/// Takes out all but the largest fan of every vertex that has several, until none has. Returns how many triangles went.
std::size_t drop_small_fans(Mesh& mesh);

}  // namespace genu
