// A square sheet, and what becomes of it bent.
#pragma once

#include "genu/mesh/mesh.h"

namespace genu::test {

/// A sheet over [-1, 1]^2 of `cells` squares a side, each cut in two, outward +z, and where each place (u, v) of it
/// goes (Vec3, m).
template <typename Place>
Mesh bent_sheet(int cells, const Place& place) {
  Mesh mesh;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) mesh.vertices.push_back(place(2.0 * i / cells - 1, 2.0 * j / cells - 1));
  const int row = cells + 1;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int v = j * row + i;
      mesh.triangles.push_back({v, v + 1, v + row});
      mesh.triangles.push_back({v + 1, v + row + 1, v + row});
    }
  return mesh;
}

}  // namespace genu::test
