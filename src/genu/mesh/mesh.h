// A triangle mesh as plain data: welded vertices (m) and counter-clockwise faces seen from outside.
#pragma once

#include <array>
#include <vector>

#include "genu/core/types.h"

namespace genu {

struct Mesh {
  std::vector<Vec3> vertices;                 ///< m, in the frame of the body that carries the surface
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices; the outward normal follows the right-hand rule

  bool empty() const { return triangles.empty(); }
};

}  // namespace genu
