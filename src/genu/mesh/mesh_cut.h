// The part of a mesh on one side of a cut.
#pragma once

#include <functional>

#include "genu/mesh/mesh.h"

namespace genu {

/// Keeps the part of every triangle where `inside` >= 0, as its signs at the corners tell. `crossing(a, b)` gives the
/// point between a, inside, and b, outside, where the cut passes; triangles that share an edge share that point.
/// Vertices very near to the cut are moved onto it, so that no slivers are left; those that nothing uses any more are
/// dropped.
Mesh cut_mesh(const Mesh& mesh, const std::function<double(const Vec3&)>& inside,
              const std::function<Vec3(const Vec3& a, const Vec3& b)>& crossing);

}  // namespace genu
