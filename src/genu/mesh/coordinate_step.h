// How finely the coordinates of a mesh file are written down.
#pragma once

#include "genu/mesh/mesh.h"

namespace genu {

/// In the mesh's unit.
struct CoordinateStep {
  double decimal = 0;  ///< 1, 0.1, 0.01, ... where all coordinates are multiples of that, as text often has them
  double single = 0;   ///< float32's step at the largest coordinate, where all are float32 numbers
};

/// 0 for what they are not; both are 0 for double precision. Decimals are told apart from float32 only where they are
/// coarser, and not where every triangle lies in a plane of constant x, y or z: few vertices may lie on them by chance,
/// and plates and boxes do by design.
CoordinateStep coordinate_step(const Mesh& mesh);

}  // namespace genu
